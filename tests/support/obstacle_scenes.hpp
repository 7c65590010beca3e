// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <gtest/gtest.h>

#include "baselines/obstacle_reference.hpp"
#include "tests/support/scenes.hpp"

namespace bch::test {

/// Obstacles in arrays, and the same for brute force.
struct ObstacleScene {
  std::vector<double> x, y;
  std::vector<std::uint64_t> path_offsets{0}, obstacle_offsets{0};
  std::vector<std::uint8_t> is_area;
  std::vector<double> bottom, top;  ///< by obstacle; empty: infinite
  std::vector<baselines::ReferenceObstacle> reference;

  struct Point {
    double x, y;
  };
  void add_path(const std::vector<Point>& points, bool is_ring);
  void end_obstacle(bool area);
  /// Adds an obstacle of one path, which is a ring where the obstacle is an area.
  void add(const std::vector<Point>& points, bool area) { add_path(points, area), end_obstacle(area); }
  ObstacleSet set() const {
    return ObstacleSet({x, y, path_offsets, obstacle_offsets, is_area, bottom, top});
  }

 private:
  baselines::ReferenceObstacle open_;
};

/// Draws obstacles of all kinds in a square of half a width: walls, collinear and repeated pieces, posts, polygons with holes, nested and
/// crossing themselves, about (x, y).
ObstacleScene obstacle_scene(Random& random, std::uint32_t count, double half, double x = 0, double y = 0);

/// Draws agents of all shapes and levels in a square of half a width.
Crowd crowd_about(Random& random, const ShapeSet& shapes, std::uint32_t count, double half, double x = 0,
                  double y = 0);

/// The shapes and the set that tests of obstacles ask about.
class ObstacleTest : public testing::Test {
 protected:
  Random random{2801};
  std::vector<Shape> shapes = synthetic_shapes(2802, 40);
  ShapeSet set{shapes, {.depths = {0, 3, 6, all_depths}}};
};

}  // namespace bch::test
