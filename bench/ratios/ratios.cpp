// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/ratios/ratios.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <stdlib.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "bench/base/command_line.hpp"
#include "bench/base/exit_codes.hpp"
#include "bench/base/run_main.hpp"

namespace bch::bench {
namespace {

constexpr const char* description =
    "Measures the kernel against the scalar reference, and prints tables of times and ratios. The rows of a "
    "table\n"
    "are timed in turns, so ratios hold on a busy machine, too. Every answer is checked before it is timed.";
constexpr const char* footer =
    "Any option of Google Benchmark, such as --benchmark_filter=<regex> or --benchmark_format=json, replaces "
    "the\n"
    "tables with that library's own report, which has more benchmarks (--benchmark_list_tests=true names "
    "them).\n"
    "PASS and \"needs\" compare a number with the project's goal for it.\n"
    "Example: bch_ratios --table kernel --table leaves";
constexpr const char* tables[] = {"kernel",    "leaves",    "peers",     "calls",        "crowd",
                                  "distances", "responses", "obstacles", "motions",      "bodies",
                                  "shapes",    "plans",     "slices",    "construction", "growth",
                                  "load",      "moments",   "checks",    "paper"};

struct Options {
  SceneOptions scene;
  std::uint32_t runs = 9, most_shapes = 50'000;
  std::vector<std::string> tables;  ///< none: all
};

double load_average() {
  double load = 0;
  return getloadavg(&load, 1) == 1 ? load : 0;
}

/// Adds all benchmarks. Returns their tables, in the order of printing.
std::vector<Table> add_all(Suite& suite, Scene& scene, const Options& options) {
  std::vector<Table> all;
  for (const std::vector<Table>& some :
       {collide_tables(suite, scene), call_tables(suite, scene), crowd_tables(suite, scene),
        query_tables(suite, scene), obstacle_tables(suite, scene), motion_tables(suite, scene),
        body_tables(suite), shape_count_tables(suite, scene, options.most_shapes), plan_tables(suite, scene),
        slice_tables(suite, scene), build_tables(suite, scene), load_tables(suite, scene),
        moment_tables(suite, scene), check_tables(suite, scene)})
    all.insert(all.end(), some.begin(), some.end());
  std::vector<Table> wanted;
  for (const char* name : tables)
    if (options.tables.empty() || std::count(options.tables.begin(), options.tables.end(), name) > 0)
      wanted.push_back(
          *std::find_if(all.begin(), all.end(), [&](const Table& one) { return one.name == name; }));
  return wanted;
}

/// The benchmarks of the tables that were asked for; empty: of none.
std::string names_of(const Options& options, std::span<const Table> wanted) {
  std::string names;
  if (!options.tables.empty())
    for (const Table& table : wanted) names += (names.empty() ? "" : "|") + table.benchmarks;
  return names;
}

void print_tables(Suite& suite, Scene& scene, const Options& options, std::span<const Table> wanted) {
  std::string names;
  for (const auto& character : scene.characters()) names += (names.empty() ? "" : ", ") + character.source;
  fmt::print("# {}: {} shapes, medians of {} runs, load {:.1f}\n", names, scene.shapes().size(), options.runs,
             load_average());
  for (const Table& table : wanted) {
    table.print(suite.run(table.benchmarks));
    std::fflush(stdout);
  }
}

/// Hands over the options that are not ours, which come last and so win over what the tables want.
/// Returns: whether there are others that are nobody's.
bool initialize(char* program, const Options& options, std::vector<std::string> rest) {
  std::vector<std::string> words = {"--benchmark_enable_random_interleaving=true",
                                    fmt::format("--benchmark_repetitions={}", options.runs),
                                    "--benchmark_min_time=0.01"};
  if (!rest.empty()) words.push_back("--benchmark_display_aggregates_only=true");
  words.insert(words.end(), rest.begin(), rest.end());
  std::vector<char*> arguments{program};
  for (std::string& word : words) arguments.push_back(word.data());
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  return benchmark::ReportUnrecognizedArguments(count, arguments.data());
}

void add_options(CLI::App& program, Options& options) {
  cli::add_repeatable_option(program, "--character", options.scene.characters,
                             std::string(cli::character_help) + " (repeatable) [male, female]", "FILE");
  program.add_option("--poses", options.scene.poses, "Poses per character [100]")
      ->type_name("N")
      ->check(CLI::Range(1u, 100'000u));
  program
      .add_option("--pairs", options.scene.sizes.pairs, "Pairs per workload, except for the crowd [20000]")
      ->type_name("N")
      ->check(CLI::Range(1u, 10'000'000u));
  program.add_option("--agents", options.scene.sizes.agents, "Agents in the crowd [10000]")
      ->type_name("N")
      ->check(CLI::Range(2u, 1'000'000u));
  program.add_option("--runs", options.runs, "Number of runs; each time is the median of all runs [9]")
      ->type_name("N")
      ->check(CLI::Range(1u, 1000u));
  program
      .add_option("--shapes", options.most_shapes,
                  "For --table shapes: leave out rows with more than N shapes [50000]")
      ->type_name("N");
  cli::add_repeatable_option(program, "--table", options.tables, "Print only this table (repeatable) [all]",
                             "NAME")
      .check(CLI::IsMember(std::vector<std::string>(std::begin(tables), std::end(tables))));
}

int run(int argc, char** argv) {
  CLI::App program(description, "bch_ratios");
  program.footer(footer);
  program.allow_extras();
  Options options;
  add_options(program, options);
  if (!cli::parse_command_line(program, argc, argv)) return cli::exit_success;
  const std::vector<std::string> rest = program.remaining();
  if (initialize(argv[0], options, rest)) return cli::exit_usage;

  Suite suite;
  Scene scene(options.scene);
  // Before anything else, because a bad file should not cost minutes, and an import wants a process without
  // threads.
  scene.characters();
  const std::vector<Table> wanted = add_all(suite, scene, options);
  if (!rest.empty())
    return suite.run_by_options(names_of(options, wanted)) ? cli::exit_success : cli::exit_internal;
  print_tables(suite, scene, options, wanted);
  return cli::exit_success;
}

}  // namespace

std::string verdict(double ratio, double needed) {
  if (ratio >= needed) return fmt::format("PASS (needs {:g})", needed);
  return fmt::format("needs {:g}: {:.0f} % short", needed, 100 * (1 - ratio / needed));
}

std::string verdict_at_most(double value, double most) {
  if (value <= most) return fmt::format("PASS (at most {:g})", most);
  return fmt::format("at most {:g}: {:.0f} % over", most, 100 * (value / most - 1));
}

}  // namespace bch::bench

int main(int argc, char** argv) {
  return bch::cli::run_main("bch_ratios", [&] { return bch::bench::run(argc, argv); });
}
