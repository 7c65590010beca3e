// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <cstdlib>
#include <memory>

#include "bench/base/command_line.hpp"
#include "bench/base/exit_codes.hpp"
#include "bench/base/options.hpp"
#include "bench/base/output.hpp"
#include "bench/characters/characters.hpp"
#include "bench/lab/commands.hpp"
#include "bench/report/report.hpp"

namespace bch::cli {
namespace {

struct ReportOptions {
  report::Options report;
  std::vector<std::string> characters;
  bool quick = false, page = false;
  double radius = report::full_sizes.disc_radius;
};

std::vector<std::string> experiment_names() {
  std::vector<std::string> names;
  for (const report::Experiment& experiment : report::experiments()) names.emplace_back(experiment.name);
  return names;
}

/// An argument as a shell takes it.
std::string quoted(const std::string& argument) {
  if (!argument.empty() && argument.find_first_of(" '\"\\$&;()<>|*?#~") == std::string::npos) return argument;
  std::string text = "'";
  for (const char c : argument) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  text += '\'';
  return text;
}

std::string command_of(const ReportOptions& options) {
  std::string text = "bch_lab report --out " + quoted(options.report.folder.string());
  if (options.quick) text += " --quick";
  if (options.radius != report::full_sizes.disc_radius) text += fmt::format(" --radius {}", options.radius);
  if (options.report.seed != 1) text += fmt::format(" --seed {}", options.report.seed);
  for (const std::string& file : options.characters) text += " --character " + quoted(file);
  for (const std::string& name : options.report.experiments) text += " --experiment " + name;
  return text;
}

/// Refuses characters that the report would overwrite: the page, and every file of the folder with an ending that the
/// report writes.
void require_report_outputs(const ReportOptions& options, const std::filesystem::path& page) {
  require_outputs({{"--out", page.string()}}, options.report.characters);
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(options.report.folder, none))
    for (const char* ending : {".csv", ".json", ".gp", ".svg"})
      if (entry.path().extension() == ending)
        require_unread({"--out", entry.path().string()}, options.report.characters);
}

void run_report(const CLI::App& command, ReportOptions& options) {
  const std::filesystem::path page = options.report.folder / "report.html";
  if (options.page) {
    require_absent(command, {"--quick", "--seed", "--character", "--experiment", "--radius"},
                   "--page measures nothing");
    report::make_page(options.report.folder);
  } else {
    make_folder(options.report.folder);
    if (!options.characters.empty()) options.report.characters = options.characters;
    require_report_outputs(options, page);
    if (options.quick) options.report.sizes = report::quick_sizes;
    options.report.sizes.disc_radius = options.radius;
    options.report.command = command_of(options);
    if (const char* data = std::getenv("BCH_TEST_DATA"); data != nullptr && *data != '\0') {
      options.report.real_characters = std::filesystem::path(data) / "characters";
      options.report.recordings = std::filesystem::path(data) / "trajectories";
    }
    report::run_report(options.report);
  }
  write_standard_output(page.string() + "\n");
}

}  // namespace

std::function<void()> add_report_command(CLI::App& program) {
  const auto options = std::make_shared<ReportOptions>();
  CLI::App& command =
      *program.add_subcommand("report", "Run the paper's experiments, and write a page of the results");
  command.footer(
      "Writes DIR/report.html, one page with all charts and tables, and the tables as CSV and JSON files.\n"
      "Charts need gnuplot. If BCH_TEST_DATA is set, real characters are read from "
      "$BCH_TEST_DATA/characters,\n"
      "and recordings of people from $BCH_TEST_DATA/trajectories.\n"
      "All experiments take 10 to 20 minutes on two cores, or 2 to 5 minutes with --quick.\n"
      "Example: bch_lab report --out report --quick");
  command.add_option("--out", options->report.folder, "Folder for the page and its tables")
      ->type_name("DIR")
      ->required();
  command.add_flag("--quick", options->quick, "Measure fewer poses, pairs, cases and runs");
  add_repeatable_option(command, "--character", options->characters,
                        std::string(character_help) + " (repeatable) [male, female]", "FILE");
  add_repeatable_option(
      command, "--experiment", options->report.experiments,
      "Run only this experiment, such as density (repeatable); a wrong name lists all names [all]", "NAME")
      .check(one_of(experiment_names()));
  command
      .add_option("--radius", options->radius,
                  "For the experiment simulated: radius of the discs that simulators move [0.2]")
      ->type_name("M")
      ->check(number_between(0.01, 2));
  add_seed_option(command, options->report.seed, "cases, packings and resamples");
  command.add_flag("--page", options->page, "Measure nothing; make the page again from the tables in DIR");
  return [options, &command] { run_report(command, *options); };
}

}  // namespace bch::cli
