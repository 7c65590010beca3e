// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

// The ways out of many obstacles at once, and out of obstacles of many segments.

#include "kernel/obstacles/ends_hull.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"
#include "tests/support/obstacle_scenes.hpp"
#include "tests/support/test.hpp"

namespace bch {
namespace {

using Obstacles = test::ObstacleTest;
using test::Crowd;
using test::ObstacleScene;

/// Returns the obstacles of a scene, each as a set of its own.
std::vector<ObstacleSet> one_by_one(const ObstacleScene& scene) {
  std::vector<ObstacleSet> sets;
  for (std::size_t obstacle = 0; obstacle < scene.is_area.size(); ++obstacle) {
    const bool is_area = scene.is_area[obstacle] != 0;
    ObstacleScene alone;
    for (auto path = scene.obstacle_offsets[obstacle]; path < scene.obstacle_offsets[obstacle + 1]; ++path) {
      std::vector<ObstacleScene::Point> points;
      for (auto i = scene.path_offsets[path]; i < scene.path_offsets[path + 1]; ++i)
        points.push_back({scene.x[i], scene.y[i]});
      alone.add_path(points, is_area);
    }
    alone.end_obstacle(is_area);
    sets.push_back(alone.set());
  }
  return sets;
}

std::vector<ObstacleScene::Point> square(double half) {
  return {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
}

/// Among many obstacles the move is the longest of those that each of them alone asks for, to the bit.
TEST_F(Obstacles, AreLeftByTheLongestOfTheMoves) {
  std::size_t compared = 0, of_many = 0;
  for (std::uint32_t k = 0; k < test::samples(400); ++k) {
    ObstacleScene scene = test::obstacle_scene(random, 8, 2);
    // Large areas that hold agents who touch something else, too.
    for (std::uint32_t i = random.below(3); i > 0; --i)
      scene.add_path(square(random.uniform(2, 9)), true), scene.end_obstacle(true);
    const Crowd crowd = test::crowd_about(random, set, 60, 2.5);
    std::vector<Penetration> ways(60), alone(60);
    std::vector<std::vector<Penetration>> by_obstacle(60);
    penetration(set, crowd.agents(), scene.set(), ways);
    for (const ObstacleSet& obstacle : one_by_one(scene)) {
      penetration(set, crowd.agents(), obstacle, alone);
      for (std::size_t i = 0; i < alone.size(); ++i)
        if (alone[i].depth > 0) by_obstacle[i].push_back(alone[i]);
    }
    for (std::size_t i = 0; i < ways.size(); ++i) {
      Penetration longest{};
      for (const Penetration& way : by_obstacle[i])
        if (way.depth > longest.depth) longest = way;
      ASSERT_EQ(ways[i].depth, longest.depth) << "scene " << k << ", agent " << i;
      ASSERT_TRUE(longest.depth == 0 ||
                  std::find(by_obstacle[i].begin(), by_obstacle[i].end(), ways[i]) != by_obstacle[i].end())
          << "scene " << k << ", agent " << i;
      compared += longest.depth > 0, of_many += by_obstacle[i].size() > 1;
    }
  }
  EXPECT_GT(compared, test::samples(10'000));
  EXPECT_GT(of_many, test::samples(4'000));
}

/// An area is left as a whole, whatever else is touched in it, and of areas that hold an agent the one that takes the longest way.
TEST_F(Obstacles, AreLeftWithAWallInside) {
  const std::vector<Shape> disc = {{{}, detail::fixed_cylinder(0.25f)}};
  const ShapeSet discs(disc);
  Crowd crowd;
  crowd.add({0, 0, 0, 0, 0});
  Penetration way{};
  ObstacleScene scene;
  scene.add_path(square(5), true), scene.end_obstacle(true);
  scene.add_path({{0.2, -1}, {0.2, 1}}, false), scene.end_obstacle(false);
  penetration(discs, crowd.agents(), scene.set(), {&way, 1});
  EXPECT_NEAR(way.depth, 5.25, 1e-5);
  for (int i = 0; i < 3'000; ++i)
    scene.add_path(square(6 + 0.001 * (i * 7 % 3'000)), true), scene.end_obstacle(true);
  penetration(discs, crowd.agents(), scene.set(), {&way, 1});
  EXPECT_NEAR(way.depth, 0.25 + 6 + 2.999, 1e-5);
}

/// An obstacle of n segments that are all touched takes n log n steps: these would take an hour by n squared.
TEST_F(Obstacles, AreLeftThoughAllOfManySegmentsAreTouched) {
  const std::vector<Shape> disc = {{{}, detail::fixed_cylinder(0.3f)}};
  const ShapeSet discs(disc);
  const std::uint32_t count = 16 * test::samples(32'000);
  ObstacleScene pillar, star, grid;
  std::vector<ObstacleScene::Point> corners, spikes;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count, c = std::cos(angle), s = std::sin(angle);
    corners.push_back({0.2 * c, 0.2 * s});
    spikes.push_back(i % 2 == 0 ? ObstacleScene::Point{0, 0} : ObstacleScene::Point{9 * c, 9 * s});
    // Segments that go up to the right, side by side, whose ends are on two lines.
    const double aside = 0.1 * (-1 + 2.0 * i / count);
    grid.add_path({{-1 - aside, -1 + aside}, {1 - aside, 1 + aside}}, false);
  }
  pillar.add_path(corners, true), pillar.end_obstacle(true);
  star.add_path(spikes, false), star.end_obstacle(false);
  grid.end_obstacle(false);
  Crowd crowd;
  crowd.add({0, 0.1, 0, 0, 0});
  Penetration way{};
  penetration(discs, crowd.agents(), pillar.set(), {&way, 1});
  EXPECT_NEAR(way.depth, 0.4, 1e-5);
  EXPECT_NEAR(way.x, 1, 1e-5);
  penetration(discs, crowd.agents(), star.set(), {&way, 1});
  EXPECT_NEAR(way.depth, 0.2, 1e-3);
  penetration(discs, crowd.agents(), grid.set(), {&way, 1});
  EXPECT_GT(way.depth, 0);
}

/// The hull tells what all ends do: on a grid, where everything is exact, and anywhere else.
TEST_F(Obstacles, HaveTheHullOfTheirEnds) {
  detail::EndsHull hull;
  for (std::uint32_t k = 0; k < test::samples(20'000); ++k) {
    std::vector<detail::EndsHull::Point> ends;
    const std::uint32_t kind = random.below(4);
    for (std::uint32_t i = 1 + random.below(kind == 0 ? 4 : 60); i > 0; --i) {
      const double a = random.uniform(-4, 4), x = kind < 2 ? random.below(7) : std::cos(a);
      ends.push_back({x, kind == 0 ? x : kind == 1 ? random.below(7) : kind == 2 ? std::sin(a) : a});
    }
    hull.clear();
    for (const auto& end : ends) hull.add(end);
    hull.close();
    const double angle = random.uniform(-4, 4), c = random.below(2) == 0 ? random.below(3) : std::cos(angle),
                 s = random.below(2) == 0 ? -1.0 * random.below(3) : std::sin(angle);
    for (const detail::EndsHull::Point way : {detail::EndsHull::Point{c, s}, {-c, -s}, {-s, c}, {s, -c}}) {
      const auto of = [&](detail::EndsHull::Point end) { return way.x * end.x + way.y * end.y; };
      double most = -std::numeric_limits<double>::infinity();
      for (const auto& end : ends) most = std::max(most, of(end));
      if (kind < 2 && std::round(way.x) == way.x && std::round(way.y) == way.y)
        ASSERT_EQ(hull.most(of), most) << k;
      else
        ASSERT_NEAR(hull.most(of), most, 1e-15 * (1 + std::abs(most))) << k;
    }
  }
}

}  // namespace
}  // namespace bch
