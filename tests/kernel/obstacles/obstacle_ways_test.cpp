// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/obstacles/ends_hull.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"
#include "tests/support/obstacle_scenes.hpp"
#include "tests/support/test.hpp"

// The ways out of many obstacles at once, and out of obstacles of many segments.

namespace bch {
namespace {

using Obstacles = test::ObstacleTest;
using test::Crowd;
using test::ObstacleScene;

std::vector<ObstacleScene::Point> square(double half) {
  return {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
}

/// Among many obstacles the move is the longest of those that each of them alone asks for, to the bit.
TEST_F(Obstacles, AreLeftByTheLongestOfTheMoves) {
  std::size_t compared = 0, of_many = 0;
  for (std::uint32_t k = 0; k < test::samples(400); ++k) {
    ObstacleScene scene = test::obstacle_scene(random, 8, 2);
    // Large areas that hold agents who touch something else, too.
    for (std::uint32_t i = random.below(3); i > 0; --i) scene.add(square(random.uniform(2, 9)), true);
    const Crowd crowd = test::crowd_about(random, set, 60, 2.5);
    std::vector<Penetration> ways(60), alone(60);
    std::vector<std::vector<Penetration>> by_obstacle(60);
    penetration(set, crowd.agents(), scene.set(), ways);
    for (std::uint32_t obstacle = 0; obstacle < scene.is_area.size(); ++obstacle) {
      penetration(set, crowd.agents(), scene.part({&obstacle, 1}).set(), alone);
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
  const ShapeSet discs(std::vector<Shape>{{{}, detail::fixed_cylinder(0.25f)}});
  Crowd crowd;
  crowd.add({0, 0, 0, 0, 0});
  Penetration way{};
  ObstacleScene scene;
  scene.add(square(5), true);
  scene.add({{0.2, -1}, {0.2, 1}}, false);
  penetration(discs, crowd.agents(), scene.set(), {&way, 1});
  EXPECT_NEAR(way.depth, 5.25, 1e-5);
  for (int i = 0; i < 3'000; ++i) scene.add(square(6 + 0.001 * (i * 7 % 3'000)), true);
  penetration(discs, crowd.agents(), scene.set(), {&way, 1});
  EXPECT_NEAR(way.depth, 0.25 + 6 + 2.999, 1e-5);
}

/// An obstacle of n segments that are all touched takes n log n steps: these would take an hour by n squared.
TEST_F(Obstacles, AreLeftThoughAllOfManySegmentsAreTouched) {
  const ShapeSet discs(std::vector<Shape>{{{}, detail::fixed_cylinder(0.3f)}});
  const std::uint32_t count = 16 * test::samples(32'000);
  ObstacleScene pillar, star, grid;
  std::vector<ObstacleScene::Point> corners, spikes;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count, c = std::cos(angle), s = std::sin(angle);
    corners.push_back({0.2 * c, 0.2 * s});
    spikes.push_back(i % 2 == 0 ? ObstacleScene::Point{0, 0} : ObstacleScene::Point{9 * c, 9 * s});
    // Segments that go up to the right, side by side, whose ends are on two lines.
    const double aside = 0.1 * (-1 + 2.0 * i / count);
    grid.add_polyline({{-1 - aside, -1 + aside}, {1 - aside, 1 + aside}}, false);
  }
  pillar.add(corners, true);
  star.add(spikes, false);
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

// ---- The ways and times of agents among obstacles, and what is said of wrong input.

/// Repeated points are no sides, and a post is left the way that a disc is beside it.
TEST_F(Obstacles, AreLeftAcrossRealSides) {
  const ShapeSet discs(std::vector<Shape>{{{}, detail::fixed_cylinder(0.3f)}});
  ObstacleScene scene, post;
  scene.add({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 1}}, true);
  scene.add({{5, 0}, {5, 0}, {5, 2}}, false);
  post.add({{0, 0}}, false);
  Crowd crowd;
  crowd.add({0, -0.1, 0.75, 0.5, 0}), crowd.add({0, 5.2, 0.1, 0.5, 0});
  std::vector<Penetration> ways(2);
  penetration(discs, crowd.agents(), scene.set(), ways);
  EXPECT_NEAR(ways[0].depth, 0.2, 1e-5);
  EXPECT_EQ(ways[0].x, -1);
  EXPECT_NEAR(ways[1].depth, 0.1, 1e-5);
  EXPECT_EQ(ways[1].x, 1);
  for (std::size_t k = 0; k < 2; ++k) crowd.x[k] = 0.144 * (k == 0 ? 1 : -1), crowd.y[k] = 0.192;
  penetration(discs, crowd.agents(), post.set(), ways);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(ways[k].depth, 0.06, 1e-5);
    EXPECT_NEAR(ways[k].x, k == 0 ? 0.6 : -0.6, 1e-6);
    EXPECT_NEAR(ways[k].y, 0.8, 1e-6);
  }
}

/// An agent that has moved by its penetration is free of the segment; where there is one wall, its discs do not collide any more.
TEST_F(Obstacles, AreLeftByMovingOut) {
  const ShapeSet discs(shapes, {.depths = {0, 3, 6, all_depths}, .outlines = false});
  std::size_t moved = 0;
  for (std::uint32_t k = 0; k < test::samples(200'000); ++k) {
    const bool is_pillar = k % 2 == 0;
    ObstacleScene scene;
    const double angle = random.uniform(-4, 4), c = std::cos(angle), s = std::sin(angle);
    const double radius = k % 4 == 0 ? 40 : random.uniform(0.05, 1);
    const double rc = radius * c, rs = radius * s;
    if (is_pillar)
      scene.add({{rc, rs}, {-rs, rc}, {-rc, -rs}, {rs, -rc}}, true);
    else
      scene.add({{-2 * c, -2 * s}, {random.uniform(0, 3) * c, 2 * s}}, false);
    const ObstacleSet obstacles = scene.set();
    Crowd crowd = test::crowd_about(random, set, 1, is_pillar ? radius + 0.2 : 2);
    std::vector<Penetration> way(1);
    std::vector<std::uint8_t> hits(1);
    collide(discs, crowd.agents(), obstacles, hits);
    penetration(set, crowd.agents(), obstacles, way);
    ASSERT_TRUE(hits[0] == 0 || way[0].depth > 0) << k;
    if (way[0].depth == 0) continue;
    // To either side of a line; out of a pillar by its width at most.
    const double widest =
        2 * static_cast<double>(set.bounding_radius(crowd.shape[0])) + (is_pillar ? 2 * radius : 0);
    ASSERT_LE(static_cast<double>(way[0].depth), widest * 1.001) << k;
    ASSERT_NEAR(way[0].x * way[0].x + way[0].y * way[0].y, 1, 1e-8);
    crowd.x[0] += static_cast<double>(way[0].depth) * way[0].x;
    crowd.y[0] += static_cast<double>(way[0].depth) * way[0].y;
    penetration(set, crowd.agents(), obstacles, way);
    collide(discs, crowd.agents(), obstacles, hits);
    ASSERT_EQ(hits[0], 0) << k << " depth " << way[0].depth;
    ASSERT_EQ(way[0].depth, 0) << k;
    ++moved;
  }
  EXPECT_GT(moved, test::samples(30'000));
}

/// Before the time of impact nothing touches, and then something does.
TEST_F(Obstacles, AreTouchedInTime) {
  std::size_t touched = 0, passed = 0;
  for (std::uint32_t k = 0; k < test::samples(1'000); ++k) {
    const ObstacleScene scene = test::obstacle_scene(random, 12, 3);
    const ObstacleSet obstacles = scene.set();
    Crowd crowd = test::crowd_about(random, set, 200, 4);
    std::vector<double> dx, dy;
    for (std::size_t i = 0; i < crowd.x.size(); ++i)
      dx.push_back(random.below(5) == 0 ? 0 : random.uniform(-4, 4)), dy.push_back(random.uniform(-4, 4));
    std::vector<float> time(crowd.x.size()), distance(crowd.x.size());
    time_of_impact(set, crowd.agents(), {dx, dy}, obstacles, time);
    const auto clearances_at = [&](const std::vector<double>& fraction) {
      Crowd moved = crowd;
      for (std::size_t i = 0; i < fraction.size(); ++i)
        moved.x[i] += fraction[i] * dx[i], moved.y[i] += fraction[i] * dy[i];
      clearance(set, moved.agents(), obstacles, {distance});
    };
    std::vector<double> fraction(time.size());
    for (int sample = 0; sample < 8; ++sample) {
      for (std::size_t i = 0; i < fraction.size(); ++i)
        fraction[i] = random.uniform(0, 1) * std::min(1.0, static_cast<double>(time[i]) * (1 - 1e-6));
      clearances_at(fraction);
      for (std::size_t i = 0; i < fraction.size(); ++i)
        ASSERT_TRUE(time[i] == 0 || distance[i] > 0)
            << "scene " << k << ", agent " << i << ", time " << time[i];
    }
    for (std::size_t i = 0; i < fraction.size(); ++i)
      fraction[i] = std::isinf(time[i]) ? 0 : static_cast<double>(time[i]);
    clearances_at(fraction);
    for (std::size_t i = 0; i < fraction.size(); ++i) {
      if (std::isinf(time[i])) {
        ++passed;
        continue;
      }
      ASSERT_LT(distance[i], 1e-5f) << "scene " << k << ", agent " << i << ", time " << time[i];
      touched += time[i] > 0;
    }
  }
  EXPECT_GT(touched, test::samples(10'000));
  EXPECT_GT(passed, test::samples(10'000));
}

TEST_F(Obstacles, RejectWhatIsWrong) {
  const std::vector<double> x = {0, 1}, y = {0, 1}, bad = {0, std::nan("")}, far = {0, 2e9};
  const std::vector<std::uint64_t> paths = {0, 2}, beyond = {0, 3}, back = {0, 2, 1, 2}, one = {0, 1};
  const std::vector<std::uint8_t> two = {0, 1};
  const auto why = [](const ObstacleArrays& in) { return test::complaint([&] { ObstacleSet{in}; }); };
  EXPECT_EQ(why({x, {}, paths}), "obstacles: expected 2 values of y, as many as of x, found 0");
  EXPECT_EQ(why({x, y, {}}), "obstacles: expected polyline offsets from 0 to the 2 points, found others");
  EXPECT_EQ(why({x, y, beyond}), "obstacles: expected polyline offsets from 0 to the 2 points, found others");
  EXPECT_EQ(why({x, y, back}), "obstacles: expected ascending polyline offsets, found 1 after 2");
  EXPECT_EQ(why({x, y, paths, paths}),
            "obstacles: expected obstacle offsets from 0 to the 1 polylines, found others");
  EXPECT_EQ(why({x, y, paths, one, two}),
            "obstacles: expected 1 values of is_area, one per obstacle, found 2");
  const std::vector<double> high = {2}, low = {1}, none = {std::nan("")};
  EXPECT_EQ(why({x, y, paths, {}, {}, x}),
            "obstacles: expected 1 values of bottom, one per obstacle, found 2");
  EXPECT_EQ(why({x, y, paths, {}, {}, {}, x}),
            "obstacles: expected 1 values of top, one per obstacle, found 2");
  EXPECT_EQ(why({x, y, paths, {}, {}, high, low}),
            "obstacles: obstacle 0: expected a bottom below the top, found 2 to 1 m");
  EXPECT_EQ(why({x, y, paths, {}, {}, none}),
            "obstacles: obstacle 0: expected a bottom below the top, found nan to inf m");
  EXPECT_EQ(why({x, y, paths, {}, {}, {}, none}),
            "obstacles: obstacle 0: expected a bottom below the top, found -inf to nan m");
  EXPECT_EQ(why({bad, y, paths}), "obstacles: point 1: expected a position within +-1e9 m, found (nan, 1)");
  EXPECT_EQ(why({x, far, paths}), "obstacles: point 1: expected a position within +-1e9 m, found (1, 2e+09)");
  const ObstacleSet wall({x, y, paths});
  EXPECT_THROW(wall.obstacle_of(1), std::out_of_range);
  const Crowd crowd = test::crowd_about(random, set, 2, 3);
  std::vector<std::uint8_t> hits(3, 7);
  EXPECT_EQ(test::complaint([&] { collide(set, crowd.agents(), wall, hits); }),
            "collide: expected 2 hits, one per agent, found 3");
  std::vector<float> distance(2);
  EXPECT_EQ(test::complaint([&] { clearance(set, crowd.agents(), wall, {distance}, {.max_distance = -1}); }),
            "clearance: expected a max_distance of at least 0 m, found -1");
  const std::vector<double> distances = {1, -1};
  hits.resize(2);
  EXPECT_EQ(test::complaint([&] { within(set, crowd.agents(), wall, distances, hits); }),
            "within: agent 1: expected a distance of at least 0 m, found -1");
  EXPECT_EQ(test::complaint([&] {
              time_of_impact(set, crowd.agents(), {distances, bad}, wall, distance);
            }),
            "time_of_impact: agent 1: expected a displacement within +-1e9 m, found (-1, nan)");
  EXPECT_EQ(hits, std::vector<std::uint8_t>(2, 7));
}

}  // namespace
}  // namespace bch
