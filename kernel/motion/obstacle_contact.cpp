// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <string>
#include <vector>

#include <bch/obstacles.hpp>

#include "kernel/motion/obstacle_search.hpp"
#include "kernel/motion/valid_motions.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/floating_point_state.hpp"

namespace bch {

using namespace detail;

void first_contact(std::span<const Motion> motions, const ObstacleSet& obstacles,
                   const TimeInterval& interval, std::span<double> times, double tolerance) {
  constexpr const char* query = "first_contact";
  constexpr std::size_t grain = 16;
  const FloatingPointStateGuard floats;
  check_size({query, "motion", motions.size()}, times.size(), "times");
  require_valid(query, interval, tolerance);
  const std::vector<MotionFacts> facts = valid_motions(query, motions);
  const Implementation& implementation = chosen(nullptr, query);
  std::vector<double> found(motions.size());
  for_ranges(motions.size(), grain, [&](std::size_t begin, std::size_t end) {
    ObstacleSearch search(implementation, obstacles.view(), tolerance);
    for (std::size_t i = begin; i < end; ++i)
      found[i] = within_limit(
          query, [i] { return "motion " + std::to_string(i); },
          [&] { return search.first(facts[i], interval.from, interval.to); });
  });
  std::copy(found.begin(), found.end(), times.begin());
}

double free_until(const Motion& motion, std::span<const Motion> others, const ObstacleSet& obstacles,
                  const TimeInterval& interval, double tolerance) {
  const double first = free_until(motion, others, interval, tolerance);
  double of_obstacles = never;
  first_contact({&motion, 1}, obstacles, {interval.from, std::min(first, interval.to)}, {&of_obstacles, 1},
                tolerance);
  return std::min(first, of_obstacles);
}

}  // namespace bch
