// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/body_scenes.hpp"
#include "tests/support/implementations.hpp"
#include "tests/support/obstacle_scenes.hpp"
#include "tests/support/test.hpp"

// The nearest place of an agent that is free of all neighbours and obstacles at once.
namespace bch {
namespace {

using test::BodyCrowd;
using test::ObstacleScene;
using test::Random;
using Ways = std::vector<Penetration>;
using Hits = std::vector<std::uint8_t>;

constexpr std::uint32_t directions = 16;

/// Calls a query of a set by the options that it takes.
Ways ways_of(const ShapeSet& set, const Agents& agents, std::span<const Pair> pairs,
             const ObstacleSet* obstacles, const CollideOptions& options = {}) {
  Ways ways(agents.size());
  nearest_free(set, agents, pairs, obstacles, directions, ways, options);
  return ways;
}
Ways ways_of(const BodySet& set, const Agents& agents, std::span<const Pair> pairs,
             const ObstacleSet* obstacles, const CollideOptions& options = {}) {
  Ways ways(agents.size());
  nearest_free(set, agents, pairs, obstacles, directions, ways, options.implementation);
  return ways;
}
void find_hits(const ShapeSet& set, const Agents& agents, std::span<const Pair> pairs, Hits& hits,
               const CollideOptions& options) {
  collide(set, agents, pairs, hits, options);
}
void find_hits(const BodySet& set, const Agents& agents, std::span<const Pair> pairs, Hits& hits,
               const CollideOptions&) {
  collide(set, agents, pairs, hits);
}
void find_hits(const ShapeSet& set, const Agents& agents, const ObstacleSet& obstacles, Hits& hits,
               const CollideOptions& options) {
  collide(set, agents, obstacles, hits, options);
}
void find_hits(const BodySet& set, const Agents& agents, const ObstacleSet& obstacles, Hits& hits,
               const CollideOptions&) {
  collide(set, agents, obstacles, hits);
}

std::vector<Pair> all_pairs(std::size_t agents) {
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < agents; ++i)
    for (std::uint32_t j = 0; j < agents; ++j)
      if (i != j) pairs.push_back({i, j});
  return pairs;
}

/// Tells which agents collide with anything if each alone has moved a part of its way, along it or along another direction.
template <class Set>
Hits hits_after(const Set& set, const Agents& agents, const ObstacleSet& obstacles, const Ways& ways,
                double share, double turned, const CollideOptions& options) {
  const auto n = static_cast<std::uint32_t>(agents.size());
  // Behind the agents come their moved copies.
  std::vector<std::uint32_t> shape;
  std::vector<double> x, y, z, heading;
  std::vector<std::uint8_t> level;
  for (std::uint32_t k = 0; k < 2 * n; ++k) {
    const std::uint32_t i = k % n;
    const double way = k < n ? 0 : share * double{ways[i].depth};
    shape.push_back(agents.shape[i]), heading.push_back(agents.heading[i].x);
    x.push_back(agents.x[i] + way * (std::cos(turned) * ways[i].x - std::sin(turned) * ways[i].y));
    y.push_back(agents.y[i] + way * (std::sin(turned) * ways[i].x + std::cos(turned) * ways[i].y));
    if (!agents.z.empty()) z.push_back(agents.z[i]);
    if (!agents.level.empty()) level.push_back(agents.level[i]);
  }
  const Agents both{shape, x, y, heading, level, z};
  std::vector<Pair> pairs = all_pairs(n);
  for (Pair& pair : pairs) pair.first += n;
  Hits of_pairs(pairs.size()), hits(2 * n);
  find_hits(set, both, pairs, of_pairs, options);
  find_hits(set, both, obstacles, hits, options);
  hits.erase(hits.begin(), hits.begin() + n);
  for (std::size_t i = 0; i < pairs.size(); ++i) hits[pairs[i].first - n] |= of_pairs[i];
  return hits;
}

struct Counts {
  std::size_t moved = 0, nearer = 0, free = 0;
};

/// Checks the ways of a scene: they end free, nobody moves without need, and nearer places are taken.
template <class Set>
void expect_free(const Set& set, const Agents& agents, const ObstacleScene& scene,
                 const CollideOptions& options, Counts& counts) {
  const ObstacleSet obstacles = scene.set();
  std::vector<Pair> pairs = all_pairs(agents.size());
  const Ways ways = ways_of(set, agents, pairs, &obstacles, options);
  const Hits before = hits_after(set, agents, obstacles, ways, 0, 0, options),
             after = hits_after(set, agents, obstacles, ways, 1, 0, options);
  for (std::size_t i = 0; i < ways.size(); ++i) {
    ASSERT_EQ(after[i], 0) << i << ": " << ways[i].depth;
    ASSERT_EQ(ways[i].depth > 0, before[i] != 0) << i;
    ASSERT_NEAR(std::hypot(ways[i].x, ways[i].y), 1, 1e-9);
    counts.moved += before[i];
  }
  for (std::uint32_t k = 0; k < directions; ++k)
    for (double share = 0.04; share < 1; share += 0.12) {
      const double angle = 2 * std::numbers::pi * k / directions;
      const Hits hits = hits_after(set, agents, obstacles, ways, share, angle, options);
      for (std::size_t i = 0; i < hits.size(); ++i)
        if ((1 - share) * double{ways[i].depth} > 1e-4) ++counts.nearer, counts.free += hits[i] == 0;
    }
  std::ranges::reverse(pairs);
  EXPECT_TRUE(ways_of(set, agents, pairs, &obstacles, options) == ways) << "neighbours in another order";
}

class FreeOfAll : public testing::TestWithParam<double> {
 protected:
  const double at = GetParam();
};
INSTANTIATE_TEST_SUITE_P(Centre, FreeOfAll, testing::Values(0, 3e5, -9e8));

TEST_P(FreeOfAll, OutlinesEndFreeOfNeighboursAndObstacles) {
  Random random(5711);
  const std::vector<Shape> shapes = test::synthetic_shapes(5712, 40);
  for (const Leaves leaves : {Leaves::segments, Leaves::discs}) {
    const bool exact = leaves == Leaves::segments;
    const ShapeSet set(shapes, exact ? ShapeSetPlan{} : ShapeSetPlan{.depths = {0, 3, all_depths}});
    Counts counts;
    for (std::uint32_t round = 0; round < test::samples(8); ++round) {
      const ObstacleScene scene = test::obstacle_scene(random, 1 + random.below(20), 4, at, -at);
      const test::Crowd crowd = test::crowd_about(random, set, 40, 4, at, -at);
      expect_free(set, crowd.agents(), scene, {nullptr, leaves}, counts);
    }
    EXPECT_GT(counts.moved, 15u * test::samples(8));
    // Where discs are tested, leaves may overlap although nodes above them do not.
    const double stays = exact ? 0.0005 : 0.02;
    EXPECT_LE(static_cast<double>(counts.free), stays * static_cast<double>(counts.nearer)) << exact;
  }
}

TEST_P(FreeOfAll, BodiesEndFreeOfNeighboursAndObstacles) {
  Random random(5713);
  const BodySet bodies = test::random_bodies(random);
  Counts counts;
  for (std::uint32_t round = 0; round < test::samples(8); ++round) {
    ObstacleScene scene = test::obstacle_scene(random, 1 + random.below(20), 4, at, -at);
    for (std::size_t i = 0; round % 3 != 0 && i < scene.is_area.size(); ++i) {
      const double bottom = random.uniform(-1, 3);
      scene.bottom.push_back(random.below(4) == 0 ? -HUGE_VAL : bottom);
      scene.top.push_back(random.below(4) == 0 ? HUGE_VAL : bottom + random.uniform(0, 1));
    }
    BodyCrowd crowd = test::random_body_crowd(random, 40, bodies.body_count(), 8, 2);
    for (double& x : crowd.x) x += at - 4;
    for (double& y : crowd.y) y += -at - 4;
    expect_free(bodies, crowd.agents(), scene, {}, counts);
  }
  EXPECT_GT(counts.moved, 15u * test::samples(8));
  EXPECT_LE(static_cast<double>(counts.free), 0.0005 * static_cast<double>(counts.nearer));
}

TEST(FreeOfAllAlone, IsTheWayOfAPair) {
  Random random(5714);
  const BodySet bodies = test::random_bodies(random);
  const BodyCrowd crowd = test::random_body_crowd(random, 40, bodies.body_count(), 2.5, 0.4);
  std::vector<Pair> pairs;  // each agent with one that comes later
  for (std::uint32_t i = 0; i + 1 < crowd.x.size(); ++i) pairs.push_back({i, i + 1});
  Ways expected(pairs.size());
  nearest_free(bodies, crowd.agents(), pairs, directions, expected);
  for (const Implementation& implementation : test::supported()) {
    Ways ways = ways_of(bodies, crowd.agents(), pairs, nullptr, {&implementation});
    EXPECT_EQ(ways.back(), (Penetration{0, 1, 0})) << "has no neighbour";
    ways.pop_back();
    EXPECT_EQ(ways, expected) << implementation.name;
  }
}

/// Whoever goes on against the normal of its touch collides again.
template <class Set>
void expect_touches(const Set& set, const Agents& agents, const ObstacleSet& obstacles) {
  const std::size_t n = agents.size();
  const std::vector<Pair> pairs = all_pairs(n);
  Ways ways(n), back(n);
  std::vector<Penetration::Touch> touches(n);
  nearest_free(set, agents, pairs, &obstacles, directions, ways, {}, touches);
  EXPECT_TRUE(ways == ways_of(set, agents, pairs, &obstacles));
  std::size_t touching = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto& [point, normal] = touches[i];
    const double x{normal.x}, y{normal.y}, z{normal.z};
    ASSERT_NEAR(std::hypot(x, y, z), ways[i].depth > 0 ? 1 : 0, 1e-6) << i;
    if (ways[i].depth == 0) continue;
    ++touching;
    ASSERT_GE(x * ways[i].x + y * ways[i].y, -1e-6) << i;
    // As one way from where the agent was.
    const double to_x = double{ways[i].depth} * ways[i].x - 5e-4 * x,
                 to_y = double{ways[i].depth} * ways[i].y - 5e-4 * y, to = std::hypot(to_x, to_y);
    back[i] = {static_cast<float>(to), to_x / to, to_y / to};
  }
  const Hits hits = hits_after(set, agents, obstacles, back, 1, 0, {});
  std::size_t against_normals = 0;
  for (std::size_t i = 0; i < n; ++i) against_normals += ways[i].depth > 0 && hits[i] != 0;
  EXPECT_GT(touching, n / 4);
  EXPECT_GE(static_cast<double>(against_normals), 0.95 * static_cast<double>(touching));
}

TEST(FreeOfAllAlone, EndsWhereTheAgentTouchesWhatItLeftLast) {
  Random random(5717);
  const ShapeSet set(test::synthetic_shapes(5718, 40), ShapeSetPlan{});
  const BodySet bodies = test::random_bodies(random);
  const ObstacleSet obstacles = test::obstacle_scene(random, 20, 4).set();
  const test::Crowd crowd = test::crowd_about(random, set, 100, 4);
  expect_touches(set, crowd.agents(), obstacles);
  BodyCrowd of_bodies = test::random_body_crowd(random, 60, bodies.body_count(), 8, 2);
  for (double& x : of_bodies.x) x -= 4;
  for (double& y : of_bodies.y) y -= 4;
  expect_touches(bodies, of_bodies.agents(), obstacles);
}

TEST(FreeOfAllAlone, IsTheSameOnEveryImplementation) {
  Random random(5715);
  const ShapeSet set(test::synthetic_shapes(5716, 40), {.depths = {3, all_depths}});
  const std::vector<Pair> pairs = all_pairs(60);
  // Ways that are longer than an agent need more walls than are known at first.
  for (const double half : {4.0, 4.0, 1.5, 0.6}) {
    const ObstacleSet obstacles = test::obstacle_scene(random, 20, half).set();
    const test::Crowd crowd = test::crowd_about(random, set, 60, half);
    const Ways ways = ways_of(set, crowd.agents(), pairs, &obstacles);
    for (const Implementation& implementation : test::supported())
      EXPECT_EQ(ways_of(set, crowd.agents(), pairs, &obstacles, {&implementation}), ways)
          << implementation.name << ", " << half << " m";
  }
}

/// A square of 0.2 m at (x, y), and a ball of 0.1 m there, half a metre up, among obstacles.
class SmallOne : public testing::Test {
 protected:
  Penetration way(const ObstacleSet& obstacles, double x, double y) {
    const std::vector<double> xs{x}, ys{y}, headings{0};
    const std::vector<std::uint32_t> shape{0};
    const Agents agents{shape, xs, ys, headings};
    const Penetration of_square = ways_of(square, agents, {}, &obstacles)[0],
                      of_ball = ways_of(ball, agents, {}, &obstacles)[0];
    EXPECT_NEAR(double{of_square.depth}, double{of_ball.depth}, 1e-4 * (1 + double{of_square.depth}));
    return of_square;
  }
  Penetration way(const char* wkt, double x, double y) { return way(obstacles_from_wkt(wkt), x, y); }

  ShapeSet square{std::vector<Shape>{test::contour_shape(
                      test::polygon({{-0.1f, -0.1f}, {0.1f, -0.1f}, {0.1f, 0.1f}, {-0.1f, 0.1f}}))},
                  {}};
  BodySet ball{std::vector<std::vector<Sphere>>{{{0, 0, 0.5f, 0.1f}}}};
};

TEST_F(SmallOne, LeavesAWallOnTheNearerSide) {
  const Penetration found = way("LINESTRING (-5 0, 5 0)", 0.3, -0.04);
  EXPECT_NEAR(double{found.depth}, 0.06, 1e-4);
  EXPECT_NEAR(found.y, -1, 1e-9);
}

TEST_F(SmallOne, LeavesAreasThatHoldIt) {
  EXPECT_NEAR(double{way("POLYGON ((-9 -9, 9 -9, 9 9, -9 9))", 0, 7).depth}, 2.1, 3e-4);
  const Penetration far = way("POLYGON ((-900 -900, 900 -900, 900 900, -900 900))", 100, 0);
  EXPECT_NEAR(double{far.depth}, 800.1, 0.05);
  EXPECT_NEAR(far.x, 1, 1e-9);
  // The hole of an area is free, and an island in it is not.
  const char* const room =
      "MULTIPOLYGON (((-9 -9, 9 -9, 9 9, -9 9), (-3 -3, 3 -3, 3 3, -3 3)), ((-1 -1, 1 -1, 1 1, -1 1)))";
  EXPECT_NEAR(double{way(room, 0, 0.7).depth}, 0.4, 3e-4);
  EXPECT_NEAR(double{way(room, 0, 4).depth}, 1.1, 3e-4);
}

TEST_F(SmallOne, PassesWhatIsTooNarrow) {
  // Between walls 0.15 m apart there is no room.
  const char* const walls = "MULTILINESTRING ((-9 0, 9 0), (-9 0.15, 9 0.15), (-9 0.3, 9 0.3))";
  EXPECT_NEAR(double{way(walls, 0, 0.12).depth}, 0.22, 1e-4);
  EXPECT_NEAR(double{way(walls, 0, 0.16).depth}, 0.24, 1e-4);
}

TEST_F(SmallOne, RefusesWhatIsInvalid) {
  const std::vector<double> zero(2, 0.0);
  const std::vector<std::uint32_t> shape(2, 0);
  const Agents agents{shape, zero, zero, zero};
  Ways ways(2);
  const auto said = [&](std::span<const Pair> pairs, std::uint32_t number) {
    return test::complaint([&] { nearest_free(square, agents, pairs, nullptr, number, ways); });
  };
  const std::vector<Pair> one{{0, 1}}, nobody{{1, 2}};
  EXPECT_EQ(said(one, 16), "accepted");
  EXPECT_EQ(said(one, 15), "nearest_free: expected an even number of directions from 2 to 256, found 15");
  EXPECT_TRUE(test::has(said(nobody, 16), "pair 0"));
  ways.resize(3);
  EXPECT_EQ(said(one, 16), "nearest_free: expected 2 answers, one per agent, found 3");
}

}  // namespace
}  // namespace bch
