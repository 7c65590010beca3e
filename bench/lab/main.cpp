// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <cstdlib>

#include "bench/base/command_line.hpp"
#include "bench/base/exit_codes.hpp"
#include "bench/base/interrupt.hpp"
#include "bench/base/options.hpp"
#include "bench/base/output.hpp"
#include "bench/base/run_main.hpp"
#include "bench/base/threads.hpp"
#include "bench/lab/models.hpp"
#include "bench/report/report.hpp"
#include "bench/stability/tables.hpp"

namespace {

using namespace bch;
using namespace bch::cli;

struct ReportOptions {
  report::Options report;
  double radius = report::full_sizes.disc_radius;
  bool quick = false, smallest = false;
};

void add_report_options(CLI::App& command, ReportOptions& options) {
  std::vector<std::string> names;
  for (const report::Experiment& experiment : report::experiments()) names.emplace_back(experiment.name);
  command.footer(
      "Writes what was measured into DIR, as CSV. bench/report/report.py DIR then writes DIR/index.html, "
      "with figures\n"
      "and verdicts. If BCH_TEST_DATA is set, real characters are read from $BCH_TEST_DATA/characters, and\n"
      "recordings of people from $BCH_TEST_DATA/trajectories.\n"
      "All experiments take 10 to 20 minutes on two cores, or 2 to 5 minutes with --quick.\n"
      "Example: bch_lab report --out report --experiment density");
  command.add_option("--out", options.report.folder, "Folder for the tables")->type_name("DIR")->required();
  add_repeatable_option(command, "--experiment", options.report.experiments,
                        "Run only this experiment (repeatable) [all]", "NAME")
      .check(one_of(names));
  command.add_flag("--quick", options.quick, "Measure fewer poses, pairs, cases and runs");
  command.add_flag("--smallest", options.smallest, "Measure hardly anything: for tests, in a minute");
  add_repeatable_option(command, "--character", options.report.characters,
                        "Character file (repeatable) [male, female]", "FILE");
  command
      .add_option("--radius", options.radius,
                  "For the experiment simulated: radius of the discs that simulators move [0.2]")
      ->type_name("M")
      ->check(number_between(0.01, 2));
  add_seed_option(command, options.report.seed, "cases, packings and resamples");
}

void run_report(ReportOptions& options) {
  if (options.quick) options.report.sizes = report::quick_sizes;
  if (options.smallest) options.report.sizes = report::smallest_sizes;
  options.report.sizes.disc_radius = options.radius;
  if (const char* data = std::getenv("BCH_TEST_DATA"); data != nullptr && *data != '\0') {
    options.report.real_characters = std::filesystem::path(data) / "characters";
    options.report.recordings = std::filesystem::path(data) / "trajectories";
  }
  // Any table there may become an output.
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(options.report.folder, none))
    if (entry.path().extension() == ".csv")
      require_unread({"--out", entry.path().string()}, options.report.characters);
  report::run_report(options.report);
  write_standard_output(options.report.folder.string() + "\n");
}

struct StabilityOptions {
  std::uint32_t pairs = 2000, threads = 0;
  bool quick = false, stiff = false;
  std::uint64_t seed = 1;
  std::string folder;
};

void add_stability_options(CLI::App& command, StabilityOptions& options) {
  command.footer(
      "Compares bch, and plain tests in float and double, with exact arithmetic, on pairs of agents that "
      "nearly touch.\n"
      "Half of the gaps are within 64 units in the last place of a float, and half are of all magnitudes. "
      "Plain tests\n"
      "take discs in world coordinates. The command fails if bch misses a collision, or reports a hit whose "
      "gap is\n"
      "larger than its documentation allows. With --stiff it measures depths as springs of penalty forces "
      "instead:\n"
      "their largest stable time step, and the energy that they create.");
  command.add_option("--pairs", options.pairs, "Pairs per row of the table [2000]")
      ->type_name("N")
      ->check(whole_between(20, 10'000'000));
  command.add_flag("--quick", options.quick, "200 pairs per row, and fewer runs of --stiff");
  command.add_flag("--stiff", options.stiff, "Drive agents into each other instead; takes minutes");
  add_seed_option(command, options.seed, "shapes and placements");
  add_threads_option(command, options.threads);
  command.add_option("--out", options.folder, "Write the tables into this folder, as CSV")->type_name("DIR");
}

void write_table(const StabilityOptions& options, const char* name, const bench::Table& table) {
  if (options.folder.empty()) return;
  make_folder(options.folder);
  write_file((std::filesystem::path(options.folder) / name).string(), table.csv());
}

void run_stiff(const StabilityOptions& options) {
  const bench::StiffReport stiff = bench::stiff_contact(
      options.quick ? bench::StiffOptions{.seconds = 2, .people = 40, .bounces = 25, .slides = 25}
                    : bench::StiffOptions{});
  write_table(options, "stiff_press.csv", press_table(stiff));
  write_table(options, "stiff_touch.csv", touch_table(stiff));
  write_standard_output(text_of(stiff));
}

void run_stability(const CLI::App& command, const StabilityOptions& options) {
  if (options.quick) require_absent(command, {"--pairs"}, "--quick chooses them");
  if (options.stiff) require_absent(command, {"--pairs", "--seed"}, "belongs to the cases, not to --stiff");
  const Threads threads(options.threads);
  if (options.stiff) return run_stiff(options);
  const auto rows = bench::stability_rows(options.quick ? 200 : options.pairs, options.seed);
  write_table(options, "stability.csv", table_of(rows));
  write_standard_output(text_of(rows));
  for (const bench::StabilityRow& row : rows)
    if (const std::string broken = broken_promise(row); !broken.empty())
      throw std::runtime_error("a promise is broken: " + broken);
}

void add_models_options(CLI::App& command, bench::ModelsOptions& options) {
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

int run(int argc, char** argv) {
  CLI::App program("Measures bounding cylinder hierarchies against the paper and against exact arithmetic.",
                   "bch_lab");
  program.footer("The exit codes are those of bch.");
  program.set_version_flag("--version", "bch_lab " BCH_VERSION);
  program.require_subcommand(1);
  program.get_formatter()->column_width(24);
  ReportOptions report;
  for (int i = 0; i < argc; ++i) report.report.command += (i > 0 ? " " : "") + std::string(argv[i]);
  StabilityOptions stability;
  CLI::App& report_command =
      *program.add_subcommand("report", "Run the paper's experiments, and write tables");
  CLI::App& stability_command =
      *program.add_subcommand("stability", "Judge collision tests on hard cases by exact arithmetic");
  bench::ModelsOptions models;
  CLI::App& models_command = *program.add_subcommand(
      "models", "Make the built-in characters' bodies of spheres anew, and compare them with the library's");
  add_models_options(models_command, models);
  add_report_options(report_command, report);
  add_stability_options(stability_command, stability);
  if (!parse_command_line(program, argc, argv)) return exit_success;
  if (models_command.parsed())
    write_standard_output(bench::remake_models(models));
  else
    report_command.parsed() ? run_report(report) : run_stability(stability_command, stability);
  return exit_success;
}

}  // namespace

int main(int argc, char** argv) {
  clean_up_on_signals(OnRequest::say_so);
  return run_main("bch_lab", [&] { return run(argc, argv); });
}
