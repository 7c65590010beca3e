// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "bench/base/exit_codes.hpp"
#include "bench/base/options.hpp"
#include "bench/base/output.hpp"
#include "bench/base/text.hpp"
#include "bench/characters/body_models.hpp"
#include "bench/characters/cost_guard.hpp"
#include "bench/cli/commands.hpp"
#include "bench/cli/crowd.hpp"
#include "bench/cli/inspection.hpp"

namespace bch::cli {
namespace {

constexpr std::uint32_t preferred_picture_depth = 6;

/// The levels asked for, and the single cylinder, which all others are compared with.
std::vector<std::uint32_t> crowd_depths(const AnswerOptions& options) {
  std::vector<std::uint32_t> depths = options.cut_depths();
  if (depths.front() != 0) depths.insert(depths.begin(), 0);
  return depths;
}

std::uint32_t picture_level(const CrowdOptions& options, const std::vector<std::uint32_t>& depths) {
  const std::uint32_t depth =
      options.svg_depth.empty() ? preferred_picture_depth : parse_depth("--svg-depth", options.svg_depth);
  const auto found = std::find(depths.begin(), depths.end(), depth);
  if (found != depths.end()) return static_cast<std::uint32_t>(found - depths.begin());
  if (!options.svg_depth.empty())
    throw UsageError(fmt::format("--svg-depth: {} is not one of --depths", options.svg_depth));
  return static_cast<std::uint32_t>(depths.size() - 1);
}

void write_files(const CrowdRun& run, std::uint32_t level) {
  const CrowdOptions& options = run.options;
  write_json(options.json, json_report(run));
  if (!options.csv.empty()) write_file(options.csv, csv_of(hits_of(run.answers)));
  if (!options.svg.empty())
    write_file(options.svg,
               draw_crowd(picture_of(run.built.shapes, run.crowd, run.answers, level, options.density)));
}

/// Answers and reports, once there are shapes.
void run_crowd(const CrowdOptions& options, std::span<const LoadedCharacter> characters,
               const BuiltShapes& built, double threshold, const ShapeSet& set, std::uint32_t level,
               unsigned threads) {
  const detail::AllOptions query = options.answer.query_options();
  const Crowd crowd = place_crowd(options.agents, options.density, set.shape_count(), options.seed);
  const CrowdAnswers answers = answer_crowd(set, crowd, query);
  const CrowdRun run{options, characters, threshold, built, set, crowd, answers, query.implementation->name,
                     threads};
  write_files(run, level);
  write_standard_output(text_report(run) + notes_text(characters));
}

void require_outputs_of(const CrowdOptions& options) {
  require_outputs({{"--json", options.json}, {"--csv", options.csv}, {"--svg", options.svg}},
                  options.shapes.inputs(options.characters));
}

void run_crowd_of_characters(const CrowdOptions& options) {
  const std::vector<std::uint32_t> depths = crowd_depths(options.answer);
  const std::uint32_t level = picture_level(options, depths);
  require_outputs_of(options);

  const CostLimits& limits = options.shapes.limits;
  // Before there are threads: see import_in_child().
  const auto characters = load_characters(options.characters, options.shapes.import_options());
  const Threads threads(options.answer.threads);
  const auto sources = list_shapes(characters, options.shapes.poses);
  std::optional<CostGuard> guard(std::in_place, limits, characters, sources.size());
  const BuiltShapes built = build_shapes(characters, sources, options.shapes.threshold, {}, limits);
  const ShapeSet set(built.shapes, {.depths = depths});
  guard.reset();
  run_crowd(options, characters, built, options.shapes.threshold, set, level, threads.count);
}

void run_baked_crowd(const CrowdOptions& options) {
  require_outputs_of(options);
  const std::string& file = options.characters.front();
  const BakedShapes baked = load_baked_for(file, options.answer);
  if (baked.set.shape_count() == 0 || baked.set.depths().front() != 0)
    throw InputError(file + ": has no shapes at depth 0, the single cylinder that others are compared with");
  const Threads threads(options.answer.threads);
  run_crowd(options, {}, {}, baked.origins.threshold, baked.set, 0, threads.count);
}

void run_live(const CLI::App& command, const CrowdOptions& options) {
  require_absent(command, {"--poses", "--threshold", "--depths", "--leaves", "--svg-depth"},
                 "belongs to shapes, not to --live");
  require_outputs_of(options);
  run_live_crowd(options);
}

void run_crowd(const CLI::App& command, const CrowdOptions& options) {
  if (options.live) return run_live(command, options);
  require_absent(command, {"--frames", "--spheres"}, "belongs to --live");
  if (options.svg.empty()) require_absent(command, {"--svg-depth"}, "belongs to --svg");
  if (std::none_of(options.characters.begin(), options.characters.end(), is_baked))
    return run_crowd_of_characters(options);
  if (options.characters.size() > 1) throw UsageError("--character: a baked file stands alone");
  require_unsettled(command, options.characters.front());
  require_absent(command, {"--svg", "--svg-depth"}, "a baked file has no hierarchies to draw");
  run_baked_crowd(options);
}

}  // namespace

std::function<void()> add_crowd_command(CLI::App& program) {
  const auto options = std::make_shared<CrowdOptions>();
  CLI::App& command =
      *program.add_subcommand("crowd", "Place a random crowd and count its collisions at each depth");
  command.footer(
      R"(For each depth, prints the number of colliding pairs, and the share of the single cylinders' collisions that it
rules out.
Shapes are drawn evenly from the poses of all characters, so a character with fewer poses appears less often.
With --live, everybody walks, each at another time of a clip, as a body of spheres bound to the bones. Prints the
time of a frame: to pose all bodies, and to find who collides.
Examples: bch crowd --agents 2000 --density 1 --svg crowd.svg
          bch crowd --live --agents 10000)");
  const OptionAdder add(command);
  add("--agents", options->agents, "N", "Number of agents [10000]", whole_between(1, 10'000'000));
  add("--density", options->density, "N", "Agents per square metre [3]", number_between(1e-4, 100));
  add_seed_option(command, options->seed, "positions, headings and shapes");
  add_repeatable_option(command, "--character", options->characters,
                        std::string(character_or_baked_help) + " (repeatable) [male, female]", "FILE");
  command.add_flag("--live", options->live,
                   "Pose everybody anew in every frame, as bodies of spheres in three dimensions");
  add("--frames", options->frames, "N", "Number of frames to time with --live [20]",
      whole_between(1, 1'000'000));
  add_spheres_option(command, options->spheres);
  options->shapes.add_to(command);
  options->answer.add_to(command);
  add("--json", options->json, "FILE", "Write the table and the options as JSON");
  add("--csv", options->csv, "FILE",
      "Write the pairs that collide, at the last of --depths or in the last frame");
  add("--svg", options->svg, "FILE", "Draw the middle of the crowd from above");
  add("--svg-depth", options->svg_depth, "DEPTH",
      "Depth of the discs that --svg draws, one of --depths [6, else the last]");
  return [options, &command] { run_crowd(command, *options); };
}

}  // namespace bch::cli
