// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/obstacles/distance_grid.hpp"
#include "kernel/obstacles/segment.hpp"
#include "tests/support/obstacle_scenes.hpp"
#include "tests/support/plane_geometry.hpp"
#include "tests/support/test.hpp"

// The bounds of distances from obstacles, by which agents that have nothing near them are left out.

namespace bch {
namespace {

using detail::DistanceBounds;
using test::ObstacleScene;
using test::Random;

long double distance_of(double x, double y, const ObstacleScene& scene) {
  long double least = std::numeric_limits<long double>::infinity();
  for (const auto& obstacle : scene.reference)
    for (const auto& [ax, ay, bx, by] : obstacle.segments)
      least = std::min(least, test::distance_to_segment<long double>(x, y, ax, ay, bx, by));
  return least;
}

/// Compares bounds with brute force at points in a square of half a width, and far outside of it. Returns: how wide they are on average.
double mean_width(const ObstacleScene& scene, test::Random& random, double x, double y, double half) {
  const ObstacleSet set = scene.set();
  constexpr int points = 3000;
  double sum = 0;
  for (int i = 0; i < points; ++i) {
    const double wide = i % 4 == 0 ? 5 * half : half;
    const double px = x + random.uniform(-wide, wide), py = y + random.uniform(-wide, wide);
    const DistanceBounds bounds = set.view().distance_grid.bounds(px, py);
    const long double distance = distance_of(px, py, scene);
    EXPECT_LE(bounds.least, distance) << px << ", " << py;
    EXPECT_GE(bounds.most, distance) << px << ", " << py;
    if (i % 4 != 0) sum += (bounds.most - bounds.least) / points;
  }
  return sum;
}

TEST(DistanceGrid, BoundsHoldAndAreNarrow) {
  test::Random random(2811);
  for (const double at : {0.0, 1e4, -1e8}) {
    const ObstacleScene few = test::obstacle_scene(random, 1, 10, at, -at / 3);
    mean_width(few, random, at, -at / 3, 10);
    const ObstacleScene many = test::obstacle_scene(random, 200, 10, at, -at / 3);
    EXPECT_LT(mean_width(many, random, at, -at / 3, 10), 1.5) << "about " << at;
  }
}

TEST(DistanceGrid, BoundsHoldOnALine) {
  test::Random random(2812);
  ObstacleScene scene;
  for (int i = 0; i < 100; ++i) {
    const double x = random.uniform(-50, 50);
    scene.add({{x, 2}, {x + 0.3, 2}}, false);
  }
  mean_width(scene, random, 0, 2, 60);
  const ObstacleSet set = scene.set();
  for (const auto& obstacle : scene.reference)
    EXPECT_LT(set.view().distance_grid.bounds(obstacle.segments[0][0], 2).most, 0.5);
}

TEST(DistanceGrid, OfAPost) {
  test::Random random(2813);
  ObstacleScene scene;
  scene.add({{3, -4}}, false);
  EXPECT_LT(mean_width(scene, random, 3, -4, 1e3), 2e3);
}

TEST(DistanceGrid, OfNothingIsFarFromEverything) {
  const ObstacleSet set = ObstacleScene().set();
  EXPECT_GT(set.view().distance_grid.bounds(1, 2).least, 1e20);
  EXPECT_GT(set.view().distance_grid.bounds(-1e9, 1e9).least, 1e20);
}

/// What no grid can tell is said to be near.
TEST(DistanceGrid, LongSegmentsAcrossEverything) {
  test::Random random(2814);
  ObstacleScene scene;
  for (int i = 0; i < 2000; ++i) {
    const double along = random.uniform(-100, 100), aside = random.uniform(-100, 100);
    scene.add({{along, -1000}, {aside, 1000}}, false);
  }
  const ObstacleSet set = scene.set();
  for (int i = 0; i < 1000; ++i) {
    const double x = random.uniform(-200, 200), y = random.uniform(-1200, 1200);
    EXPECT_LE(set.view().distance_grid.bounds(x, y).least, distance_of(x, y, scene));
  }
}

}  // namespace
}  // namespace bch
