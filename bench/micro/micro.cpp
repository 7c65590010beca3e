// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/micro/micro.hpp"

#include <benchmark/benchmark.h>

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "bench/base/command_line.hpp"
#include "bench/base/exit_codes.hpp"
#include "bench/base/run_main.hpp"
#include "bench/workload/scene_options.hpp"

namespace {

constexpr const char* description =
    "Microbenchmarks of collision queries, of construction and of loading. Times are nanoseconds a pair;\n"
    "every answer is checked before it is timed. Made on first use, so that a narrow --benchmark_filter\n"
    "starts soon.";
constexpr const char* footer =
    "Google Benchmark's own options work too: --benchmark_filter=<regex>, --benchmark_list_tests=true,\n"
    "--benchmark_min_time=<seconds>, --benchmark_out=<file> ...";

int run(int argc, char** argv) {
  CLI::App program(description, "bch_micro");
  program.footer(footer);
  program.allow_extras();
  bch::bench::SceneOptions options;
  bch::cli::add_repeatable_option(program, "--character", options.characters,
                                  std::string(bch::cli::character_help) + " (repeatable) [male, female]",
                                  "FILE");
  bch::bench::add_size_options(program, options);
  if (!bch::cli::parse_command_line(program, argc, argv)) return bch::cli::exit_success;

  std::vector<std::string> rest = program.remaining();
  std::vector<char*> arguments{argv[0]};
  for (std::string& word : rest) arguments.push_back(word.data());
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return bch::cli::exit_usage;

  bch::bench::Scene scene(options);
  bch::bench::register_collide_benchmarks(scene);
  bch::bench::register_distance_benchmarks(scene);
  bch::bench::register_response_benchmarks(scene);
  bch::bench::register_build_benchmarks(scene);
  bch::bench::register_load_benchmarks(scene);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return bch::cli::exit_success;
}

}  // namespace

int main(int argc, char** argv) {
  return bch::cli::run_main("bch_micro", [&] { return run(argc, argv); });
}
