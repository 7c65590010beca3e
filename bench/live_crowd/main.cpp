// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "bench/base/command_line.hpp"
#include "bench/base/exit_codes.hpp"
#include "bench/base/median.hpp"
#include "bench/base/run_main.hpp"
#include "bench/base/text.hpp"
#include "bench/base/threads.hpp"
#include "bench/characters/characters.hpp"
#include "bench/live_crowd/live_crowd.hpp"

namespace {

using namespace bch;
using namespace bch::bench;

constexpr double frame = 1.0 / 60;            ///< seconds
constexpr std::uint32_t frames_to_warm = 30;  ///< until shapes have places that are large enough

struct Options {
  std::vector<std::uint32_t> agents = {300, 1000};
  std::vector<std::uint32_t> depths = {all_depths, 6, 3, 0};
  std::uint32_t frames = 200, threads = 0;
  std::vector<std::string> characters = {"default:male", "default:female"};
};

void require_right(const LiveCrowd& crowd) {
  if (!std::ranges::equal(crowd.hits(), crowd.hits_of_a_new_set()))
    throw std::runtime_error("a set whose shapes were replaced answers unlike a new one");
}

void print_row(std::span<const Character> characters, std::uint32_t agents, std::uint32_t depth,
               std::uint32_t frames) {
  LiveCrowd crowd(characters, agents, depth);
  for (std::uint32_t i = 0; i < frames_to_warm; ++i) crowd.step(frame);
  require_right(crowd);
  std::vector<double> shapes, pairs, answers, whole;
  for (std::uint32_t i = 0; i < frames; ++i) {
    const FrameTime time = crowd.step(frame);
    shapes.push_back(1e3 * time.shapes), pairs.push_back(1e3 * time.pairs),
        answers.push_back(1e3 * time.answers);
    whole.push_back(1e3 * (time.shapes + time.pairs + time.answers));
  }
  require_right(crowd);
  const double milliseconds = cli::median(whole);
  fmt::print("| {} | {} | {:.0f} | {:.2f} | {:.2f} | {:.3f} | {:.3f} | {} of {} |\n", cli::grouped(agents),
             cli::depth_name(depth), 1e3 / milliseconds, milliseconds, cli::median(shapes),
             cli::median(pairs), cli::median(answers), std::ranges::count(crowd.hits(), 1),
             crowd.pairs().size());
  std::fflush(stdout);
}

int run(int argc, char** argv) {
  CLI::App program(
      "Measures a crowd whose characters all get a new pose in every frame: poses, outlines, trees, broad "
      "phase, queries.",
      "bch_live_crowd");
  Options options;
  program.add_option("--agents", options.agents, "Number of agents (repeatable) [300, 1000]")
      ->check(CLI::Range(1u, 1'000'000u));
  program
      .add_option("--frames", options.frames, "Number of frames; each time is the median of all frames [200]")
      ->check(CLI::Range(1u, 1'000'000u));
  program.add_option("--threads", options.threads, "Number of threads [all]")->check(CLI::Range(1u, 1024u));
  cli::add_repeatable_option(program, "--character", options.characters,
                             std::string(cli::character_help) + " (repeatable) [male, female]", "FILE");
  if (!cli::parse_command_line(program, argc, argv)) return cli::exit_success;

  // Before there are threads: see import_in_child().
  std::vector<Character> characters;
  for (cli::LoadedCharacter& loaded : cli::load_characters(options.characters, {}))
    characters.push_back(std::move(loaded.character));
  const cli::Threads threads(options.threads);
  fmt::print(
      "# {}, medians of {}\n\n| agents | depth | frames per second | ms a frame | of it shapes | broad phase "
      "| queries | "
      "collisions |\n"
      "|---|---|---|---|---|---|---|---|\n",
      cli::counted(threads.count, "thread"), cli::counted(options.frames, "frame"));
  for (const std::uint32_t agents : options.agents)
    for (const std::uint32_t depth : options.depths) print_row(characters, agents, depth, options.frames);
  return cli::exit_success;
}

}  // namespace

int main(int argc, char** argv) {
  return cli::run_main("bch_live_crowd", [&] { return run(argc, argv); });
}
