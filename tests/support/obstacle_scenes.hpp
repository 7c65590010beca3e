// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <gtest/gtest.h>

#include "baselines/obstacle_reference.hpp"
#include "kernel/runtime/all_options.hpp"
#include "tests/support/scenes.hpp"

namespace bch::test {

/// Obstacles in arrays, and the same for brute force.
struct ObstacleScene {
  std::vector<double> x, y;
  std::vector<std::uint64_t> polyline_offsets{0}, obstacle_offsets{0};
  std::vector<std::uint8_t> is_area;
  std::vector<double> bottom, top;  ///< by obstacle; empty: infinite
  std::vector<baselines::ReferenceObstacle> reference;

  struct Point {
    double x, y;
  };
  void add_polyline(const std::vector<Point>& points, bool is_ring);
  void end_obstacle(bool area);
  /// Adds an obstacle of one polyline, which is a ring where the obstacle is an area.
  void add(const std::vector<Point>& points, bool area) { add_polyline(points, area), end_obstacle(area); }
  ObstacleSet set() const {
    return ObstacleSet({x, y, polyline_offsets, obstacle_offsets, is_area, bottom, top});
  }

  /// Returns some of the obstacles, without heights.
  ObstacleScene part(std::span<const std::uint32_t> obstacles) const;

 private:
  baselines::ReferenceObstacle open_;
};

/// Returns whether an area holds a point, by the parity of the segments that a ray along x meets.
template <class Real>
bool contains(const baselines::ReferenceObstacle& area, Real x, Real y) {
  bool odd = false;
  for (const auto& [ax, ay, bx, by] : area.segments)
    if ((ay > y) != (by > y)) odd ^= x - ax < (bx - ax) * ((y - ay) / (by - ay));
  return odd;
}

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

/// What all queries say of a scene.
struct ObstacleAnswers {
  std::vector<std::uint8_t> hits, near;
  std::vector<float> distance, deepest, time;
  std::vector<Vec2> direction;
  std::vector<DiscPair> discs, deepest_discs;
  std::vector<NearestPoints> points;
  std::vector<Penetration> ways;
  friend bool operator==(const ObstacleAnswers&, const ObstacleAnswers&) = default;
};

inline ObstacleAnswers all_answers(const ShapeSet& set, const Agents& agents, const ObstacleSet& obstacles,
                                   const detail::AllOptions& options, std::span<const double> distances,
                                   const Displacements& displacements) {
  const std::size_t n = agents.size();
  ObstacleAnswers all{std::vector<std::uint8_t>(n),  std::vector<std::uint8_t>(n),
                      std::vector<float>(n),         std::vector<float>(n),
                      std::vector<float>(n),         std::vector<Vec2>(n),
                      std::vector<DiscPair>(n),      std::vector<DiscPair>(n),
                      std::vector<NearestPoints>(n), std::vector<Penetration>(n)};
  collide(set, agents, obstacles, all.hits, options);
  within(set, agents, obstacles, distances, all.near, options.distance_leaves, options.implementation);
  detail::AllOptions how = options;
  clearance(set, agents, obstacles, {all.distance, all.direction, all.discs, all.points}, how);
  how.overlap = Overlap::deepest;
  clearance(set, agents, obstacles, {.distance = all.deepest, .discs = all.deepest_discs}, how);
  penetration(set, agents, obstacles, all.ways, options);
  time_of_impact(set, agents, displacements, obstacles, all.time, options);
  return all;
}

/// Returns the largest float that is not above a number: what queries make of a distance.
inline float rounded_down(double value) {
  const float nearest = static_cast<float>(value);
  return static_cast<double>(nearest) > value ? std::nextafter(nearest, -HUGE_VALF) : nearest;
}

/// Distances to ask about, some of them 0.
inline std::vector<double> distances_for(Random& random, std::size_t count) {
  std::vector<double> distances;
  for (std::size_t i = 0; i < count; ++i)
    distances.push_back(random.below(8) == 0 ? 0 : random.uniform(0, 1));
  return distances;
}

}  // namespace bch::test
