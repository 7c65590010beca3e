// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/ratios/ratios.hpp"

#include <fmt/format.h>
#include <stdlib.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>

#include "bench/base/command_line.hpp"
#include "bench/base/exit_codes.hpp"
#include "bench/base/run_main.hpp"
#include "bench/workload/scene_options.hpp"

namespace {

using namespace bch::bench;

constexpr const char* description =
    "How many times as fast as the plain traversal the kernel is, and what is asked of it. All of a row is\n"
    "measured in turn, so that the ratios hold on a machine that is not quiet; every answer is checked "
    "first.";

double load_average() {
  double load = 0;
  return getloadavg(&load, 1) == 1 ? load : 0;
}

struct Options {
  std::uint32_t runs = 9, most_shapes = 50'000;
  std::vector<std::string> tables;  ///< none: all
};

struct Table {
  const char* name;
  std::function<void(Scene&, const Options&)> print;
};

const std::vector<Table>& tables() {
  static const std::vector<Table> all = {
      {"kernel", [](Scene& scene, const Options& o) { print_kernel_ratios(scene, o.runs); }},
      {"leaves", [](Scene& scene, const Options& o) { print_leaf_ratios(scene, o.runs); }},
      {"peers", [](Scene& scene, const Options& o) { print_peer_ratios(scene, o.runs); }},
      {"calls", [](Scene& scene, const Options& o) { print_call_ratios(scene, o.runs); }},
      {"crowd", [](Scene& scene, const Options& o) { print_crowd_ratios(scene, o.runs); }},
      {"distances", [](Scene& scene, const Options& o) { print_distance_ratios(scene, o.runs); }},
      {"responses", [](Scene& scene, const Options& o) { print_response_ratios(scene, o.runs); }},
      {"shapes",
       [](Scene& scene, const Options& o) { print_shape_count_ratios(scene, o.runs, o.most_shapes); }},
      {"plans", [](Scene& scene, const Options& o) { print_plan_table(scene, o.runs); }},
      {"construction", [](Scene& scene, const Options& o) { print_build_ratios(scene, o.runs); }},
      {"paper", [](Scene& scene, const Options& o) { print_paper_table(scene, o.runs); }},
  };
  return all;
}

std::vector<std::string> table_names() {
  std::vector<std::string> names = {"growth"};  // of no scene
  for (const Table& table : tables()) names.push_back(table.name);
  return names;
}

bool wants(const Options& options, const std::string& table) {
  return options.tables.empty() ||
         std::find(options.tables.begin(), options.tables.end(), table) != options.tables.end();
}

void print_tables(Scene& scene, const Options& options) {
  std::string names;
  for (const auto& character : scene.characters()) names += (names.empty() ? "" : ", ") + character.source;
  fmt::print("# {}: {} shapes, medians of {} runs, load {:.1f}\n", names, scene.shapes().size(), options.runs,
             load_average());
  for (const Table& table : tables())
    if (wants(options, table.name)) table.print(scene, options);
  fmt::print("\n");
}

int run(int argc, char** argv) {
  CLI::App program(description, "bch_ratios");
  SceneOptions scene;
  Options options;
  std::vector<std::string> files;
  bch::cli::add_repeatable_option(
      program, "--character", files,
      "Character file (repeatable): all of them make a second scene, beside the built-in ones", "FILE");
  add_size_options(program, scene);
  program.add_option("--runs", options.runs, "Runs of which the medians are taken [9]")
      ->type_name("N")
      ->check(CLI::Range(1u, 1000u));
  program.add_option("--shapes", options.most_shapes, "Leave out rows of more shapes [50000]")
      ->type_name("N");
  bch::cli::add_repeatable_option(program, "--table", options.tables, "One table alone (repeatable) [all]",
                                  "NAME")
      .check(CLI::IsMember(table_names()));
  if (!bch::cli::parse_command_line(program, argc, argv)) return bch::cli::exit_success;

  Scene built_in(scene);
  scene.characters = files;
  Scene given(scene);
  // Before anything else, because a bad file should not cost minutes, and an import wants a process without
  // threads.
  if (!files.empty()) given.characters();
  print_tables(built_in, options);
  if (wants(options, "growth")) print_build_growth(scene.poses, options.runs);
  if (!files.empty()) print_tables(given, options);
  return bch::cli::exit_success;
}

}  // namespace

namespace bch::bench {

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
  return bch::cli::run_main("bch_ratios", [&] { return run(argc, argv); });
}
