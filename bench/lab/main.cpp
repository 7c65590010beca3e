// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include <bch/bodies.hpp>
#include <bch/characters.hpp>

#include "bench/base/command_line.hpp"
#include "bench/base/exit_codes.hpp"
#include "bench/base/interrupt.hpp"
#include "bench/base/options.hpp"
#include "bench/base/output.hpp"
#include "bench/lab/figures.hpp"
#include "bench/report/report.hpp"
#include "layout/base/base64.hpp"
#include "layout/body/model/model_bytes.hpp"

namespace {

using namespace bch;
using namespace bch::cli;

struct ReportOptions {
  report::Options report;
  bool quick = false, smallest = false;
};

void add_report_options(CLI::App& command, ReportOptions& options) {
  std::vector<std::string> names;
  for (const report::Experiment& experiment : report::experiments()) names.emplace_back(experiment.name);
  command.footer(
      "Writes what was measured into DIR, as CSV. bench/report/report.py DIR then writes DIR/index.html, "
      "with figures\n"
      "and verdicts.\n"
      "All experiments take some ten minutes on two cores, or one minute with --quick.\n"
      "Example: bch_lab report --out report --experiment density");
  command.add_option("--out", options.report.folder, "Folder for the tables")->type_name("DIR")->required();
  add_repeatable_option(command, "--experiment", options.report.experiments,
                        "Run only this experiment (repeatable) [all]", "NAME")
      .check(one_of(names));
  command.add_flag("--quick", options.quick, "Measure fewer poses, pairs, cases and runs");
  command.add_flag("--smallest", options.smallest, "Measure hardly anything: for tests, in a minute");
  add_repeatable_option(command, "--character", options.report.characters,
                        "Character file (repeatable) [male, female]", "FILE");
  add_seed_option(command, options.report.seed, "cases, packings and resamples");
}

void run_report(ReportOptions& options) {
  if (options.quick) options.report.sizes = report::quick_sizes;
  if (options.smallest) options.report.sizes = report::smallest_sizes;
  // Any table there may become an output.
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(options.report.folder, none))
    if (entry.path().extension() == ".csv")
      require_unread({"--out", entry.path().string()}, options.report.characters);
  report::run_report(options.report);
  write_standard_output(options.report.folder.string() + "\n");
}

struct ModelsOptions {
  std::uint32_t spheres = 0;  ///< of the only models that are made; all: 0
  std::string folder;         ///< for the files that the library is made of; none: empty
};

constexpr std::size_t line_length = 100;

/// Returns a model as layout/body/default_models has it.
std::string source_of(const std::string& bytes) {
  const std::string text = detail::to_base64(bytes);
  std::string source = "// SPDX-License-Identifier: MIT\n// Copyright (c) 2026 the bch authors\n";
  for (std::size_t at = 0; at < text.size(); at += line_length)
    source += fmt::format("\"{}\",\n", std::string_view(text).substr(at, line_length));
  return source;
}

/// Makes the built-in characters' models anew, and writes them or compares them with those that come with the library.
/// Returns: a line a model, with its size.
std::string remake_models(const ModelsOptions& options) {
  const std::pair<const char*, Character> characters[] = {{"male", default_male()},
                                                          {"female", default_female()}};
  std::string lines;
  for (const auto& [name, character] : characters)
    for (const std::uint32_t spheres : {64u, 128u, 256u, 512u}) {
      if (options.spheres != 0 && options.spheres != spheres) continue;
      const std::string bytes = detail::bytes_of(make_body(character, {.spheres = spheres}));
      const std::string file = fmt::format("{}_{}.inc", name, spheres);
      if (!options.folder.empty())
        write_file((std::filesystem::path(options.folder) / file).string(), source_of(bytes));
      else if (bytes != detail::bytes_of(default_body(character, spheres)))
        throw std::runtime_error(file + " holds another model than make_body() makes");
      lines += fmt::format("{}: {} bytes\n", file, bytes.size());
    }
  return lines;
}

void add_models_options(CLI::App& command, ModelsOptions& options) {
  command.footer(
      "Fails if one is another, unless it writes them. Takes up to a minute a model.\n"
      "Example: bch_lab models --out layout/body/default_models");
  command.add_option("--spheres", options.spheres, "Make only the models of so many spheres [all]")
      ->type_name("N")
      ->check(one_of({"64", "128", "256", "512"}));
  command
      .add_option("--out", options.folder, "Write the files that the library is built with into this folder")
      ->type_name("DIR");
}

void add_figures_options(CLI::App& command, std::string& folder) {
  command.footer("Example: bch_lab figures --out bench");
  command.add_option("--out", folder, "Folder for the figures")->type_name("DIR")->required();
}

/// Draws the figures of chapters that no other command draws.
/// Returns: a line a figure.
std::string draw_figures(const std::string& folder) {
  const std::pair<const char*, std::string (*)()> figures[] = {{"stages.svg", lab::draw_stages},
                                                               {"distances.svg", lab::draw_distances},
                                                               {"motion.svg", lab::draw_motion}};
  std::string files;
  for (const auto& [name, draw] : figures) {
    const std::string file = (std::filesystem::path(folder) / name).string();
    write_file(file, draw());
    files += file + "\n";
  }
  return files;
}

int run(int argc, char** argv) {
  CLI::App program("Measures bounding cylinder hierarchies against the paper and against exact arithmetic.",
                   "bch_lab");
  program.footer("The exit codes are those of bch.");
  program.set_version_flag("--version", "bch_lab " BCH_VERSION);
  program.require_subcommand(1);
  program.get_formatter()->column_width(24);
  ReportOptions report;
  for (int i = 0; i < argc; ++i) report.report.command += (i > 0 ? " " : "") + std::string(argv[i]);
  CLI::App& report_command =
      *program.add_subcommand("report", "Run the paper's experiments, and write tables");
  ModelsOptions models;
  CLI::App& models_command = *program.add_subcommand(
      "models", "Make the built-in characters' bodies of spheres anew, and compare them with the library's");
  std::string figures_folder;
  CLI::App& figures_command = *program.add_subcommand("figures", "Draw figures of the chapters");
  add_figures_options(figures_command, figures_folder);
  add_models_options(models_command, models);
  add_report_options(report_command, report);
  if (!parse_command_line(program, argc, argv)) return exit_success;
  if (models_command.parsed())
    write_standard_output(remake_models(models));
  else if (figures_command.parsed())
    write_standard_output(draw_figures(figures_folder));
  else
    run_report(report);
  return exit_success;
}

}  // namespace

int main(int argc, char** argv) {
  clean_up_on_signals(OnRequest::say_so);
  return run_main("bch_lab", [&] { return run(argc, argv); });
}
