// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "bench/base/text.hpp"
#include "bench/base/wkt_input.hpp"
#include "bench/characters/shape_table.hpp"
#include "bench/cli/query.hpp"

namespace bch::cli {
namespace {

/// Returns the numbers before and behind a comma; NaN for other text.
std::pair<double, double> numbers_of(const std::string& text) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) return {none, none};
  return {parse_number(text.substr(0, comma)).value_or(none),
          parse_number(text.substr(comma + 1)).value_or(none)};
}

/// Refuses options that mean nothing in combination with the others.
void require_no_misfits(const CLI::App& command, const QueryCommandOptions& options) {
  const bool collide = options.what == "collide", within = options.what == "within",
             clearance = options.what == "clearance", walls = !options.obstacles.file.empty(),
             tests_leaves = collide || options.what == "contacts";
  struct Misfit {
    bool is_one;
    std::vector<const char*> options;
    const char* reason;
  };
  const Misfit misfits[] = {
      {walls, {"--directions", "--direction"}, "obstacles have directions of their own"},
      {options.what != "penetration", {"--directions", "--direction"}, "belongs to --what penetration"},
      {!options.all_pairs, {"--max-pairs"}, "belongs to --all-pairs"},
      {!clearance, {"--overlap", "--points"}, "belongs to --what clearance"},
      {!clearance && !within, {"--max-distance"}, "belongs to --what clearance and --what within"},
      {clearance && options.overlap != "zero",
       {"--leaves"},
       "cannot be combined with --overlap deepest, which always measures discs"},
      {within && !walls,
       {"--leaves"},
       "cannot be combined with --what within, which measures discs unless --obstacles is given"},
      {!clearance && !within && !tests_leaves && !options.all_pairs,
       {"--leaves"},
       "belongs to --what collide, --what contacts, --what clearance and --all-pairs"},
      {query_kind(options.what).moving, {"--all-pairs"}, "agents that collide now touch at once"},
      {!options.direction.empty(), {"--directions"}, "--direction names the only one"},
  };
  for (const Misfit& misfit : misfits)
    if (misfit.is_one) require_absent(command, misfit.options, misfit.reason);
}

void require_of_spheres(const CLI::App& command, const QueryCommandOptions& options) {
  const char* const reason = "belongs to outlines, not to --bodies spheres";
  require_absent(command, {"--depths", "--leaves", "--threshold"}, reason);
  const QueryKind& kind = query_kind(options.what);
  if (!options.obstacles.file.empty() && kind.of_obstacles && !kind.spheres_of_obstacles)
    throw UsageError(fmt::format("--what: '{}' about --obstacles {}", options.what, reason));
  if (is_baked(options.character))
    throw UsageError(options.character +
                     ": a baked file has outlines alone, which --bodies spheres does not use");
}

}  // namespace

void require_fitting(const CLI::App& command, const QueryCommandOptions& options) {
  if (options.kind.are_spheres(command)) require_of_spheres(command, options);
  const bool walls = !options.obstacles.file.empty();
  const int named = int{options.all_pairs} + int{!options.pairs.empty()} + int{walls};
  if (named != 1)
    throw UsageError(named > 1 ? "PAIRS.csv, --all-pairs and --obstacles: name one of them"
                               : "PAIRS.csv, --all-pairs or --obstacles is missing");
  if (walls && !query_kind(options.what).of_obstacles)
    throw UsageError(fmt::format("--what: '{}' cannot be asked about --obstacles", options.what));
  if (options.what == "within" && !std::isfinite(options.max_distance))
    throw UsageError("--max-distance: --what within needs one");
  options.obstacles.require_fitting(command);
  require_no_misfits(command, options);
  if (options.directions % 2 != 0)
    throw UsageError(fmt::format("--directions: '{}' is odd", options.directions));
  options.only_direction();
}

std::optional<Vec2> QueryCommandOptions::only_direction() const {
  if (direction.empty()) return std::nullopt;
  const auto [to_x, to_y] = numbers_of(direction);
  const auto x = static_cast<float>(to_x), y = static_cast<float>(to_y);
  if (!std::isfinite(x) || !std::isfinite(y) || (x == 0 && y == 0))
    throw UsageError(fmt::format("--direction: '{}' is not X,Y with a length", direction));
  return Vec2{x, y};
}

void ObstacleOptions::add_to(CLI::App& command, const char* help) {
  const OptionAdder add(command);
  add("--obstacles", file, "FILE.wkt", help);
  command.add_flag("--walkable", walkable,
                   "Polygons of --obstacles are floors to walk on, and their borders are walls");
  add("--obstacle-heights", heights, "BOTTOM,TOP",
      "Heights of --obstacles, metres, like agents' z; bodies above or below do not collide [infinite]");
}

void ObstacleOptions::require_fitting(const CLI::App& command) const {
  if (file.empty()) require_absent(command, {"--walkable", "--obstacle-heights"}, "belongs to --obstacles");
  const auto [bottom, top] = numbers_of(heights);
  if (!heights.empty() && !(bottom <= top))
    throw UsageError(fmt::format("--obstacle-heights: '{}' is not BOTTOM,TOP, the lower first", heights));
}

std::optional<ObstacleSet> ObstacleOptions::read() const {
  if (file.empty()) return std::nullopt;
  return read_obstacles(file, walkable ? Polygons::walkable : Polygons::solid,
                        heights.empty() ? std::pair{-HUGE_VAL, HUGE_VAL} : numbers_of(heights));
}

}  // namespace bch::cli
