// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <bch/crowd.hpp>

#include "bench/base/output.hpp"
#include "bench/base/text.hpp"
#include "bench/characters/shape_table.hpp"
#include "bench/cli/commands.hpp"
#include "bench/cli/query.hpp"

namespace bch::cli {
namespace {

struct ResolveCommandOptions {
  std::string character, agents;
  ShapeOptions shapes;
  std::uint32_t spheres = 256, threads = 0;
  ObstacleOptions obstacles;
  std::size_t max_pairs = 0;  ///< 0: what is usual
  bch::Crowd::ResolveOptions how;
};

std::string report_of(const AgentTable& before, const bch::Crowd::Resolved& after) {
  double sum = 0, largest = 0;
  for (std::size_t i = 0; i < before.id.size(); ++i) {
    const double shift = std::hypot(after.x[i] - before.x[i], after.y[i] - before.y[i]);
    sum += shift, largest = std::max(largest, shift);
  }
  const auto fixed = static_cast<std::size_t>(std::ranges::count(before.mobility, 0));
  const double agents = std::max(1.0, static_cast<double>(before.id.size()));
  double turned = 0, farthest = 0;
  for (const double turn : after.turn)
    turned += std::abs(turn), farthest = std::max(farthest, std::abs(turn));
  const std::string turns =
      fact("turn", fmt::format("{:.4f} rad on average, {:.4f} rad at most", turned / agents, farthest));
  return fact("agents", fmt::format("{}, {} fixed", grouped(before.id.size()), grouped(fixed))) +
         fact("sweeps", grouped(after.sweeps)) +
         fact("shift", fmt::format("{:.4f} m on average, {:.4f} m at most", sum / agents, largest)) +
         (after.turn.empty() ? "" : turns) +
         fact("left", fmt::format("{} in collision, {} at a wall", counted(after.left.size(), "pair"),
                                  counted(after.agents_at_walls.size(), "agent")));
}

void run_resolve(const CLI::App& command, const ResolveCommandOptions& options) {
  options.obstacles.require_fitting(command);
  if (options.how.directions % 2 != 0)
    throw UsageError(fmt::format("--directions: '{}' is odd", options.how.directions));
  if (is_baked(options.character))
    throw UsageError(options.character + ": a baked file has outlines alone, without spheres");
  const std::vector<LoadedCharacter> from{load_character(options.character, options.shapes.import_options())};
  const auto sources = list_shapes(from, options.shapes.poses);
  AgentTable table = read_agents(options.agents, static_cast<std::uint32_t>(sources.size()), 1, false);
  const std::optional<ObstacleSet> obstacles = options.obstacles.read();
  const Threads threads(options.threads);
  const std::vector<std::uint32_t> shape = table.shape;
  const BodySet bodies = posed_bodies(make_models(from, options.spheres), keep_used(sources, table));
  bch::Crowd::ResolveOptions how = options.how;
  how.mobility = table.mobility;
  how.obstacles = obstacles ? &*obstacles : nullptr;
  bch::Crowd crowd;
  const auto after = within_limit(options.max_pairs, options.agents, table, [&](std::size_t most) {
    crowd = bch::Crowd({.max_pairs = most});
    return crowd.resolve(bodies, table.agents(), how);
  });
  const std::string report = report_of(table, after) + notes_text(from);
  table.shape = shape;
  table.x.assign(after.x.begin(), after.x.end()), table.y.assign(after.y.begin(), after.y.end());
  for (std::size_t i = 0; i < after.turn.size(); ++i) table.heading[i] += after.turn[i];
  write_standard_data(csv_of(table));
  std::fputs(report.c_str(), stderr);  // standard output is for data
}

}  // namespace

std::function<void()> add_resolve_command(CLI::App& program) {
  const auto options = std::make_shared<ResolveCommandOptions>();
  CLI::App& command = *program.add_subcommand(
      "resolve", "Move people, as little as possible, until no bodies overlap each other or a wall");
  command.footer(
      R"(Bodies are sets of spheres bound to the bones, tested in 3D. A sweep finds all pairs that overlap, and moves all
people once. Prints AGENTS.csv with new x, y and heading, and to standard error the number of sweeps, the mean and
largest shift and turn, and how many pairs and people at walls remain if there is not enough room (the exit code is
still 0).
AGENTS.csv is that of bch query, with one more column:
  mobility       0 (does not move) to 1: of two people moved apart, one with half the mobility moves half as far [1]
Example: bch resolve default:female agents.csv --obstacles walls.wkt > moved.csv)");
  const OptionAdder add(command);
  bch::Crowd::ResolveOptions& how = options->how;
  add("CHARACTER", options->character, "", character_help)->required();
  add("AGENTS.csv", options->agents, "", "Columns id,shape,x,y,heading[,z][,mobility]")->required();
  options->obstacles.add_to(command, "Also keep people out of these walls and polygons, in well-known text");
  add("--sweeps", how.sweeps, "N", "Maximum number of sweeps [100]", whole_between(0, 1'000'000));
  add("--directions", how.directions, "N",
      "Even number of directions in which people may be moved apart [16]", whole_between(2, 256));
  add("--gap", how.gap, "METRES", "Gap to leave between people who are moved apart [0.001 m]",
      number_between(0, 1000));
  add("--largest-step", how.largest_step, "METRES", "Maximum shift of a person in one sweep [0.05 m]",
      number_between(0, 1000));
  add("--largest-shift", how.largest_shift, "METRES",
      "Maximum shift of a person in all sweeps together [no limit]", number_between(0, 1e9));
  add("--largest-turn", how.largest_turn, "RADIANS", "Maximum turn of a person in all sweeps together [0]",
      number_between(0, 3.2));
  add_max_pairs_option(command, options->max_pairs, "agents near each other", "agent");
  add_spheres_option(command, options->spheres);
  options->shapes.add_poses_to(command);
  options->shapes.add_import_to(command);
  add_threads_option(command, options->threads);
  return [options, &command] { run_resolve(command, *options); };
}

}  // namespace bch::cli
