// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "bench/base/exit_codes.hpp"
#include "bench/base/options.hpp"
#include "bench/base/output.hpp"
#include "bench/base/threads.hpp"
#include "bench/lab/commands.hpp"
#include "bench/lab/stability_report.hpp"
#include "bench/lab/stiff_report.hpp"
#include "bench/report/chart.hpp"

namespace bch::cli {
namespace {

namespace fs = std::filesystem;

struct StabilityOptions {
  std::uint32_t pairs = 2000;
  bool quick = false, stiff = false;
  std::uint64_t seed = 1;
  std::uint32_t threads = 0;
  std::string out, csv, json;
};

std::string in_folder(const StabilityOptions& options, std::string_view name) {
  return (fs::path(options.out) / name).string();
}

/// The files that --out means.
std::vector<OutputOption> folder_outputs(const StabilityOptions& options) {
  std::vector<std::string> names = {"style.gp"};
  if (options.stiff) {
    names.insert(names.end(), {"stiff_contact.csv", "stiff_contact.gp", "stiff_contact_steps.svg",
                               "stiff_contact_errors.svg"});
  } else {
    names.insert(names.end(), {"stability.csv", "stability_families.gp"});
    for (const bench::StabilityFamily& family : bench::stability_families())
      if (family.axis) names.push_back(fmt::format("stability_{}.svg", family.name));
  }
  std::vector<OutputOption> outputs;
  for (const std::string& name : names) outputs.push_back({"--out", in_folder(options, name)});
  return outputs;
}

/// Makes the folder as well.
void require_outputs_of(const StabilityOptions& options) {
  std::vector<OutputOption> outputs{{"--csv", options.csv}, {"--json", options.json}};
  require_outputs(outputs, {});
  if (options.out.empty()) return;
  make_folder(options.out);
  std::ranges::move(folder_outputs(options), std::back_inserter(outputs));
  require_outputs(outputs, {});
}

void require_promises(std::span<const bench::StabilityRow> rows) {
  for (const bench::StabilityRow& row : rows) {
    const std::string broken = broken_promise(row);
    if (!broken.empty()) throw std::runtime_error("a promise is broken: " + broken);
  }
}

/// Files of one half of the command; in the folder NAME.csv and what CHART.gp draws from it.
void write_files(const StabilityOptions& options, const std::string& name, const char* chart,
                 const report::Table& table) {
  if (!options.csv.empty()) write_file(options.csv, csv_of(table));
  write_json(options.json, {{name, json_of(table)}});
  if (options.out.empty()) return;
  write_file(in_folder(options, name + ".csv"), csv_of(table));
  if (!report::draw(options.out, chart))
    fmt::print(stderr, "bch: no pictures: gnuplot is not installed, or it failed\n");
}

void run_cases(const StabilityOptions& options) {
  const auto rows = bench::stability_rows(options.quick ? 200 : options.pairs, options.seed);
  write_files(options, "stability", "stability_families", table_of(rows));
  write_standard_output(text_of(rows));
  require_promises(rows);
}

void run_stiff(const StabilityOptions& options) {
  const bench::StiffReport report = bench::stiff_contact(
      options.quick ? bench::StiffOptions{.seconds = 2, .people = 40, .bounces = 25, .slides = 25}
                    : bench::StiffOptions{});
  write_files(options, "stiff_contact", "stiff_contact", table_of(report));
  write_standard_output(text_of(report));
}

void run_stability(const CLI::App& command, const StabilityOptions& options) {
  if (options.quick) require_absent(command, {"--pairs"}, "--quick chooses them");
  if (options.stiff) require_absent(command, {"--pairs", "--seed"}, "belongs to the cases, not to --stiff");
  require_outputs_of(options);
  const Threads threads(options.threads);
  options.stiff ? run_stiff(options) : run_cases(options);
}

}  // namespace

std::function<void()> add_stability_command(CLI::App& program) {
  const auto options = std::make_shared<StabilityOptions>();
  CLI::App& command =
      *program.add_subcommand("stability", "Judge collision tests on hard cases by exact arithmetic");
  command.footer(
      "Compares bch, and plain tests in float and double, with exact arithmetic, on pairs of agents that "
      "nearly touch.\n"
      "Half of the gaps are within 64 units in the last place of a float, and half are of all magnitudes. "
      "Plain tests\n"
      "take discs in world coordinates. The command fails if bch misses a collision, or reports a hit whose "
      "gap is\n"
      "larger than its documentation allows. With --stiff it measures depths as springs of penalty forces "
      "instead:\n"
      "their largest stable time step, and the energy that they create.\n"
      "Example: bch_lab stability --out stability");
  command.add_option("--pairs", options->pairs, "Pairs per row of the table [2000]")
      ->type_name("N")
      ->check(whole_between(20, 10'000'000));
  command.add_flag("--quick", options->quick, "200 pairs per row, and fewer runs of --stiff");
  command.add_flag("--stiff", options->stiff, "Drive agents into each other instead; takes minutes");
  add_seed_option(command, options->seed, "shapes and placements");
  add_threads_option(command, options->threads);
  command.add_option("--csv", options->csv, "Write the table as CSV")->type_name("FILE");
  command.add_option("--json", options->json, "Write the table as JSON")->type_name("FILE");
  command.add_option("--out", options->out, "Write CSV, and pictures by gnuplot, into this folder")
      ->type_name("DIR");
  return [options, &command] { run_stability(command, *options); };
}

}  // namespace bch::cli
