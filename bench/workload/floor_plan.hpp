// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <vector>

#include <bch/obstacles.hpp>

#include "baselines/obstacle_reference.hpp"

namespace bch::bench {

/// Holds walls of rooms and pillars in a square as a crowd stands in, for the queries against obstacles, and the same for brute
/// force.
struct FloorPlan {
  std::vector<double> x, y;
  std::vector<std::uint64_t> path_offsets{0};
  std::vector<std::uint8_t> is_area;
  std::vector<baselines::ReferenceObstacle> reference;

  ObstacleSet set() const { return ObstacleSet({x, y, path_offsets, {}, is_area}); }
};

/// Draws rooms with a side of 6 m or so and doors of 1 m, and octagonal pillars, in [0, side) by [0, side): so many segments in all, two
/// fifths of them of pillars. Walls are lines in pieces of one length, as scans and outlines of curved walls are.
FloorPlan floor_plan(std::uint32_t segments, double side, std::uint64_t seed);

}  // namespace bch::bench
