// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/obstacles/body_query.hpp"
#include "kernel/obstacles/distance_grid.hpp"
#include "kernel/obstacles/segment.hpp"
#include "tests/support/obstacle_scenes.hpp"
#include "tests/support/plane_geometry.hpp"
#include "tests/support/test.hpp"

// Agents in a large hall: its wall has many segments, and all are far.

namespace bch {
namespace {

using baselines::ObstacleReference;
using detail::DistanceBounds;
using test::Crowd;
using test::ObstacleScene;
using test::Random;

using test::infinity;

class ObstacleHall : public test::ObstacleTest {
 protected:
  /// A ring of so many segments, whose radius swings by a share of it.
  static ObstacleScene hall(double radius, std::uint32_t segments, double fraction, bool is_area) {
    ObstacleScene scene;
    std::vector<ObstacleScene::Point> points;
    for (std::uint32_t i = 0; i < segments; ++i) {
      const double angle = 2 * std::numbers::pi * i / segments,
                   r = radius * (1 + fraction * std::cos(37 * angle));
      points.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    scene.add_polyline(points, true);
    scene.end_obstacle(is_area);
    return scene;
  }
};

/// Far from the wall, next to it and beyond, distances are those of brute force over all segments.
TEST_F(ObstacleHall, IsAsFarAsBruteForceSays) {
  const ObstacleReference reference(shapes, {.depths = {0, 3, 6, all_depths}}, Leaves::discs);
  for (const bool is_area : {false, true})
    for (const double fraction : {0.0, 0.02}) {
      const ObstacleScene scene = hall(200, 2'000, fraction, is_area);
      const ObstacleSet obstacles = scene.set();
      Crowd crowd = test::crowd_about(random, set, test::samples(120), 210);
      crowd.add({0, 0, 0, 0, 3}), crowd.add({1, 1e6, -1e6, 0, 2});
      const Agents agents = crowd.agents();
      std::vector<float> distance(agents.size()), deepest(agents.size()), limited(agents.size());
      std::vector<DiscPair> discs(agents.size());
      clearance(set, agents, obstacles, {.distance = distance});
      clearance(set, agents, obstacles, {.distance = deepest, .discs = discs}, {.overlap = Overlap::deepest});
      clearance(set, agents, obstacles, {.distance = limited}, {.max_distance = 50});
      for (std::uint32_t i = 0; i < agents.size(); ++i) {
        const auto gap = reference.gap(agents, i, scene.reference);
        ASSERT_EQ(deepest[i], test::rounded_down(gap.gap)) << i;
        ASSERT_EQ(discs[i], (DiscPair{gap.disc, gap.segment})) << i;
        const bool is_contained = reference.contains_a_centre(agents, i, scene.reference[0]) ||
                                  reference.outline_contains(agents, i, scene.reference[0]);
        const float expected = is_contained ? 0 : std::max(deepest[i], 0.0f);
        ASSERT_EQ(distance[i], expected) << i;
        ASSERT_EQ(limited[i], is_contained || gap.gap <= 50 ? expected : HUGE_VALF) << i;
      }
    }
}

/// An agent deep in an area leaves it over the nearest segment.
TEST_F(ObstacleHall, IsLeftOverTheNearestSegment) {
  const ObstacleScene scene = hall(200, 2'000, 0, true);
  const ObstacleSet obstacles = scene.set();
  Crowd crowd = test::crowd_about(random, set, test::samples(200), 130);
  std::vector<Penetration> ways(crowd.x.size());
  std::vector<std::uint8_t> hits(crowd.x.size());
  penetration(set, crowd.agents(), obstacles, ways);
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const double from_centre = std::hypot(crowd.x[i], crowd.y[i]),
                 max_extent = 2 * double{set.bounding_radius(crowd.shape[i])};
    EXPECT_NEAR(double{ways[i].depth}, 200 - from_centre, max_extent);
    crowd.x[i] += double{ways[i].depth} * ways[i].x, crowd.y[i] += double{ways[i].depth} * ways[i].y;
  }
  collide(set, crowd.agents(), obstacles, hits, {.leaves = Leaves::discs});
  EXPECT_EQ(hits, std::vector<std::uint8_t>(hits.size(), 0));
}

/// A point has no sides: who stands beside one that belongs to an area leaves the area over the nearest wall.
TEST_F(ObstacleHall, IsNotLeftOverAPoint) {
  const ObstacleSet room = hall(200, 4, 0, true).set();
  const Crowd crowd = test::crowd_about(random, set, test::samples(80), 50);
  std::vector<Penetration> expected(crowd.x.size()), ways(crowd.x.size());
  penetration(set, crowd.agents(), room, expected);
  for (std::size_t i = 0; i < ways.size(); ++i) {
    ObstacleScene scene = hall(200, 4, 0, true);
    scene.obstacle_offsets.pop_back(), scene.is_area.pop_back();
    scene.add({{crowd.x[i] + 1.5 * double{set.bounding_radius(crowd.shape[i])}, crowd.y[i]}}, true);
    penetration(set, crowd.agents(), scene.set(), ways);
    EXPECT_GT(ways[i].depth, 0);
    EXPECT_EQ(ways[i].depth, expected[i].depth) << i;
    EXPECT_EQ(ways[i].x, expected[i].x) << i;
    EXPECT_EQ(ways[i].y, expected[i].y) << i;
  }
}

/// The centre of a body in two parts may lie on the wall, which neither part touches.
TEST_F(ObstacleHall, IsLeftAlsoFromTheWallItself) {
  const std::vector<std::vector<Vec2>> feet = {
      {{-0.5f, -0.125f}, {-0.25f, -0.125f}, {-0.25f, 0.125f}, {-0.5f, 0.125f}},
      {{0.25f, -0.125f}, {0.5f, -0.125f}, {0.5f, 0.125f}, {0.25f, 0.125f}}};
  const ShapeSet body({{shape_from_polygons(feet)}});
  ObstacleScene scene;
  scene.add({{-10, -10}, {-0.0625, -10}, {0, 0}, {0.0625, -10}, {10, -10}, {10, 10}, {-10, 10}}, true);
  const ObstacleSet area = scene.set();
  Crowd crowd;
  crowd.add({0, 0, 0, 0, 0}), crowd.add({0, 1e-9, 0, 0, 0});
  std::vector<Penetration> ways(2);
  penetration(body, crowd.agents(), area, ways);
  EXPECT_GT(ways[1].depth, 0.25f);
  EXPECT_NEAR(ways[0].depth, ways[1].depth, 1e-5);
}

/// A search looks at the segments that may be the nearest, and hardly any others; inside an area it does not look for them.
TEST_F(ObstacleHall, TakesNoMoreThanItsNearestSegments) {
  constexpr std::uint32_t segments = 10'000;
  for (const bool is_area : {false, true}) {
    const ObstacleSet obstacles = hall(1'000, segments, 0.01, is_area).set();
    for (const double at : {0.0, 500.0, 700.0, 840.0, 940.0}) {
      const Crowd crowd = test::crowd_about(random, set, 20, 20, at);
      const Agents agents = crowd.agents();
      const detail::ShapeSetView shapes_view = set.view();
      detail::BodyQuery query(best_implementation(), shapes_view, agents, obstacles.view(), false);
      query.prepare(0, 20, infinity, detail::SearchMode::nearest);
      std::size_t looked_at = 0;
      for (std::uint32_t i = 0; i < 20; ++i) {
        const auto nearest = query.nearest(i, infinity, 0, true);
        EXPECT_EQ(nearest.is_within, is_area);
        looked_at = std::max(looked_at, query.near().found().size());
      }
      EXPECT_LE(looked_at, segments / 50) << at;
    }
  }
}

// ---- The bounds of distances from obstacles, by which agents that have nothing near them are left out.

long double distance_of(double x, double y, const ObstacleScene& scene) {
  long double least = std::numeric_limits<long double>::infinity();
  for (const auto& obstacle : scene.reference)
    for (const auto& [ax, ay, bx, by] : obstacle.segments)
      least = std::min(least, test::distance_to_segment<long double>(x, y, ax, ay, bx, by));
  return least;
}

/// Compares bounds with brute force at points in a square of half a width, and far outside of it. Returns: how wide they are on average.
double mean_width(const ObstacleScene& scene, Random& random, double x, double y, double half) {
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
  Random random(2811);
  for (const double at : {0.0, 1e4, -1e8}) {
    const ObstacleScene few = test::obstacle_scene(random, 1, 10, at, -at / 3);
    mean_width(few, random, at, -at / 3, 10);
    const ObstacleScene many = test::obstacle_scene(random, 200, 10, at, -at / 3);
    EXPECT_LT(mean_width(many, random, at, -at / 3, 10), 1.5) << "about " << at;
  }
}

TEST(DistanceGrid, BoundsHoldOnALine) {
  Random random(2812);
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
  Random random(2813);
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
  Random random(2814);
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
