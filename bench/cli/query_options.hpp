// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include <bch/geometry.hpp>

#include "bench/base/csv_input.hpp"
#include "bench/cli/options.hpp"
#include "bench/cli/part_options.hpp"
#include "bench/cli/query_answers.hpp"

namespace bch::cli {

/// Holds what the command line of bch query says.
struct QueryCommandOptions {
  std::string character, agents, pairs, obstacles;
  bool all_pairs = false, walkable = false, guard_ids = false;
  std::string what = query_kinds().front().name;
  std::uint32_t directions = 16;
  std::string direction;         ///< empty: the best of many
  std::string obstacle_heights;  ///< empty: infinite
  double max_distance = HUGE_VAL;
  std::size_t max_pairs = 0;  ///< of neighbours, for all_pairs; 0: what is usual
  std::string overlap = "zero";
  bool points = false;
  PartOptions part;
  std::optional<Part> only;  ///< of pairs, or of agents by obstacles
  ShapeOptions shapes;
  AnswerOptions answer;

  /// Errors:  throws UsageError.
  std::optional<Vec2> only_direction() const;
  /// Errors:  throws UsageError.
  std::pair<double, double> heights_of_obstacles() const;
  /// Returns whether the heights of bodies count.
  bool compares_heights(const AgentTable& agents) const {
    return !agents.z.empty() || !obstacle_heights.empty();
  }
};

}  // namespace bch::cli
