// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/ratios.hpp"

#include <fmt/format.h>
#include <stdlib.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "bench/exit_codes.hpp"
#include "bench/scene_options.hpp"

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

void print_tables(Scene& scene, std::uint32_t runs, std::uint32_t most_shapes) {
  std::string names;
  for (const auto& character : scene.characters()) names += (names.empty() ? "" : ", ") + character.source;
  fmt::print("# {}: {} shapes, medians of {} runs, load {:.1f}\n", names, scene.shapes().size(), runs,
             load_average());
  print_kernel_ratios(scene, runs);
  print_peer_ratios(scene, runs);
  print_call_ratios(scene, runs);
  print_crowd_ratios(scene, runs);
  print_shape_count_ratios(scene, runs, most_shapes);
  print_paper_table(scene, runs);
  fmt::print("\n");
}

int run(int argc, char** argv) {
  CLI::App program(description, "bch_ratios");
  SceneOptions options;
  std::vector<std::string> files;
  std::uint32_t runs = 9, most_shapes = 50'000;
  program
      .add_option("--character", files,
                  "Character file (repeatable): all of them make a second scene, beside the built-in ones")
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_size_options(program, options);
  program.add_option("--runs", runs, "Runs of which the medians are taken [9]")
      ->type_name("N")
      ->check(CLI::Range(1u, 1000u));
  program.add_option("--shapes", most_shapes, "Leave out rows of more shapes [50000]")->type_name("N");
  CLI11_PARSE(program, argc, argv);

  Scene built_in(options);
  options.characters = files;
  Scene given(options);
  // Before anything else, because a bad file should not cost minutes, and an import wants a process without
  // threads.
  if (!files.empty()) given.characters();
  print_tables(built_in, runs, most_shapes);
  if (!files.empty()) print_tables(given, runs, most_shapes);
  return bch::cli::exit_success;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bch_ratios: %s\n", error.what());
    return bch::cli::exit_bad_input;
  }
}
