// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/ratios/ratios.hpp"

#include <benchmark/benchmark.h>

#include <CLI/CLI.hpp>

#include "bench/base/command_line.hpp"
#include "bench/base/exit_codes.hpp"

namespace bch::bench {
namespace {

constexpr const char* description =
    "Google Benchmark of the library, of the scalar reference and of other libraries. Every answer is "
    "checked\n"
    "before it is timed. bench/ratios/ratios.py runs this program and prints tables of ratios.";
constexpr const char* footer =
    "All options of Google Benchmark, such as --benchmark_filter=<regex>, --benchmark_list_tests=true or\n"
    "--benchmark_format=json, are taken as well.\n"
    "Example: bch_ratios --benchmark_filter=^collide/crowd/discs/";

SceneOptions parse(CLI::App& program, int argc, char** argv, bool& is_done) {
  SceneOptions options;
  cli::add_repeatable_option(program, "--character", options.characters,
                             std::string(cli::character_help) + " (repeatable) [male, female]", "FILE");
  program.add_option("--poses", options.poses, "Poses per character [100]")
      ->type_name("N")
      ->check(CLI::Range(1u, 100'000u));
  program.add_option("--pairs", options.sizes.pairs, "Pairs per workload, except for the crowd [20000]")
      ->type_name("N")
      ->check(CLI::Range(1u, 10'000'000u));
  program.add_option("--agents", options.sizes.agents, "Agents in the crowd [10000]")
      ->type_name("N")
      ->check(CLI::Range(2u, 1'000'000u));
  program.add_flag("--drafts", options.draft_models, "Models of spheres that take seconds and err more");
  is_done = !cli::parse_command_line(program, argc, argv);
  return options;
}

/// Hands over the options that are not ours. Returns: whether there are others that are nobody's.
bool initialize(char* program, std::vector<std::string> rest) {
  std::vector<char*> arguments{program};
  for (std::string& word : rest) arguments.push_back(word.data());
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  return benchmark::ReportUnrecognizedArguments(count, arguments.data());
}

int run(int argc, char** argv) {
  CLI::App program(description, "bch_ratios");
  program.footer(footer);
  program.allow_extras();
  bool is_done = false;
  Scene scene(parse(program, argc, argv, is_done));
  if (is_done) return cli::exit_success;
  if (initialize(argv[0], program.remaining())) return cli::exit_usage;

  // Before anything else, because a bad file should not cost minutes, and an import wants a process without threads.
  std::string names;
  for (const auto& character : scene.characters()) names += (names.empty() ? "" : ", ") + character.source;
  benchmark::AddCustomContext("characters", names);
  add_collide(scene);
#ifdef BCH_HAS_COUNTED_KERNELS
  add_stages(scene);
#endif
  add_queries(scene);
  add_crowds(scene);
  add_bodies();
  add_spheres(scene);
  add_obstacles(scene);
  add_sets(scene);
  add_construction(scene);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::ClearRegisteredBenchmarks();
  return any_wrong() ? cli::exit_internal : cli::exit_success;
}

}  // namespace
}  // namespace bch::bench

int main(int argc, char** argv) {
  return bch::cli::run_main("bch_ratios", [&] { return bch::bench::run(argc, argv); });
}
