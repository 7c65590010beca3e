// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

// The ways and times of agents among obstacles, and what is said of wrong input.

#include "layout/hierarchy/paper_hierarchies.hpp"
#include "tests/support/obstacle_scenes.hpp"
#include "tests/support/test.hpp"

namespace bch {
namespace {

using Obstacles = test::ObstacleTest;
using test::Crowd;
using test::ObstacleScene;

/// Repeated points are no sides, and a post is left the way that a disc is beside it.
TEST_F(Obstacles, AreLeftAcrossRealSides) {
  const std::vector<Shape> disc = {{{}, detail::fixed_cylinder(0.3f)}};
  const ShapeSet discs(disc);
  const std::vector<double> x = {0, 1, 1, 0, 0, 5, 5, 5}, y = {0, 0, 1, 1, 1, 0, 0, 2};
  const std::vector<std::uint64_t> paths = {0, 5, 8};
  const std::vector<std::uint8_t> areas = {1, 0};
  Crowd crowd;
  crowd.add({0, -0.1, 0.75, 0.5, 0}), crowd.add({0, 5.2, 0.1, 0.5, 0});
  std::vector<Penetration> ways(2);
  penetration(discs, crowd.agents(), ObstacleSet({x, y, paths, {}, areas}), ways);
  EXPECT_NEAR(ways[0].depth, 0.2, 1e-5);
  EXPECT_EQ(ways[0].x, -1);
  EXPECT_NEAR(ways[1].depth, 0.1, 1e-5);
  EXPECT_EQ(ways[1].x, 1);
  const std::vector<double> post_x = {0}, post_y = {0};
  const std::vector<std::uint64_t> post = {0, 1};
  for (std::size_t k = 0; k < 2; ++k) crowd.x[k] = 0.144 * (k == 0 ? 1 : -1), crowd.y[k] = 0.192;
  penetration(discs, crowd.agents(), ObstacleSet({post_x, post_y, post}), ways);
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
    if (is_pillar)
      scene.add_path({{radius * c, radius * s},
                      {-radius * s, radius * c},
                      {-radius * c, -radius * s},
                      {radius * s, -radius * c}},
                     true);
    else
      scene.add_path({{-2 * c, -2 * s}, {random.uniform(0, 3) * c, 2 * s}}, false);
    scene.end_obstacle(is_pillar);
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
    const auto clearances_at = [&](const std::vector<double>& share) {
      Crowd moved = crowd;
      for (std::size_t i = 0; i < share.size(); ++i)
        moved.x[i] += share[i] * dx[i], moved.y[i] += share[i] * dy[i];
      clearance(set, moved.agents(), obstacles, {distance});
    };
    std::vector<double> share(time.size());
    for (int sample = 0; sample < 8; ++sample) {
      for (std::size_t i = 0; i < share.size(); ++i)
        share[i] = random.uniform(0, 1) * std::min(1.0, static_cast<double>(time[i]) * (1 - 1e-6));
      clearances_at(share);
      for (std::size_t i = 0; i < share.size(); ++i)
        ASSERT_TRUE(time[i] == 0 || distance[i] > 0)
            << "scene " << k << ", agent " << i << ", time " << time[i];
    }
    for (std::size_t i = 0; i < share.size(); ++i)
      share[i] = std::isinf(time[i]) ? 0 : static_cast<double>(time[i]);
    clearances_at(share);
    for (std::size_t i = 0; i < share.size(); ++i) {
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
  EXPECT_EQ(why({x, {}, paths}), "obstacles: 2 values of x but 0 of y");
  EXPECT_EQ(why({x, y, {}}), "obstacles: path offsets do not lead from 0 to 2 points");
  EXPECT_EQ(why({x, y, beyond}), "obstacles: path offsets do not lead from 0 to 2 points");
  EXPECT_EQ(why({x, y, back}), "obstacles: path offsets: 1 after 2");
  EXPECT_EQ(why({x, y, paths, paths}), "obstacles: obstacle offsets do not lead from 0 to 1 paths");
  EXPECT_EQ(why({x, y, paths, one, two}), "obstacles: 1 obstacles but 2 values of is_area");
  const std::vector<double> high = {2}, low = {1}, none = {std::nan("")};
  EXPECT_EQ(why({x, y, paths, {}, {}, x}), "obstacles: 1 obstacles but 2 values of bottom");
  EXPECT_EQ(why({x, y, paths, {}, {}, {}, x}), "obstacles: 1 obstacles but 2 values of top");
  EXPECT_EQ(why({x, y, paths, {}, {}, high, low}), "obstacles: obstacle 0: heights from 2 to 1 m");
  EXPECT_EQ(why({x, y, paths, {}, {}, none}), "obstacles: obstacle 0: heights from nan to inf m");
  EXPECT_EQ(why({x, y, paths, {}, {}, {}, none}), "obstacles: obstacle 0: heights from -inf to nan m");
  EXPECT_EQ(why({bad, y, paths}), "obstacles: point 1: (nan, 1) m is not within +-1e9");
  EXPECT_EQ(why({x, far, paths}), "obstacles: point 1: (1, 2e+09) m is not within +-1e9");
  const ObstacleSet wall({x, y, paths});
  EXPECT_THROW(wall.obstacle_of(1), std::out_of_range);
  const Crowd crowd = test::crowd_about(random, set, 2, 3);
  std::vector<std::uint8_t> hits(3, 7);
  EXPECT_EQ(test::complaint([&] { collide(set, crowd.agents(), wall, hits); }),
            "collide: 2 agents but 3 hits");
  std::vector<float> distance(2);
  EXPECT_EQ(test::complaint([&] { clearance(set, crowd.agents(), wall, {distance}, {.max_distance = -1}); }),
            "clearance: a max_distance of -1 m");
  const std::vector<double> distances = {1, -1};
  hits.resize(2);
  EXPECT_EQ(test::complaint([&] { within(set, crowd.agents(), wall, distances, hits); }),
            "within: agent 1: a distance of -1 m");
  EXPECT_EQ(test::complaint([&] {
              time_of_impact(set, crowd.agents(), {distances, bad}, wall, distance);
            }),
            "time_of_impact: agent 1: displacement (-1, nan) m is not within +-1e9");
  EXPECT_EQ(hits, std::vector<std::uint8_t>(2, 7));
}

}  // namespace
}  // namespace bch
