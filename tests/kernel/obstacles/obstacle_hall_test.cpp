// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/obstacle_reference.hpp"
#include "kernel/obstacles/distance_grid.hpp"
#include "kernel/obstacles/gap_query.hpp"
#include "kernel/obstacles/segment.hpp"
#include "kernel/runtime/all_options.hpp"
#include "tests/support/height_scenes.hpp"
#include "tests/support/obstacle_answers.hpp"
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

constexpr double infinity = std::numeric_limits<double>::infinity();

class ObstacleHall : public test::ObstacleTest {
 protected:
  /// A ring of so many segments, whose radius swings by a share of it.
  static ObstacleScene hall(double radius, std::uint32_t segments, double share, bool is_area) {
    ObstacleScene scene;
    std::vector<ObstacleScene::Point> points;
    for (std::uint32_t i = 0; i < segments; ++i) {
      const double angle = 2 * std::numbers::pi * i / segments,
                   r = radius * (1 + share * std::cos(37 * angle));
      points.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    scene.add_path(points, true);
    scene.end_obstacle(is_area);
    return scene;
  }
};

/// Far from the wall, next to it and beyond, distances are those of brute force over all segments.
TEST_F(ObstacleHall, IsAsFarAsBruteForceSays) {
  const ObstacleReference reference(shapes, {.depths = {0, 3, 6, all_depths}}, Leaves::discs);
  for (const bool is_area : {false, true})
    for (const double share : {0.0, 0.02}) {
      const ObstacleScene scene = hall(200, 2'000, share, is_area);
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
        const bool is_held = reference.holds_a_centre(agents, i, scene.reference[0]) ||
                             reference.outline_holds(agents, i, scene.reference[0]);
        const float expected = is_held ? 0 : std::max(deepest[i], 0.0f);
        ASSERT_EQ(distance[i], expected) << i;
        ASSERT_EQ(limited[i], is_held || gap.gap <= 50 ? expected : HUGE_VALF) << i;
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
                 reach = 2 * double{set.bounding_radius(crowd.shape[i])};
    EXPECT_NEAR(double{ways[i].depth}, 200 - from_centre, reach);
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
      detail::BodyQuery body(best_implementation(), shapes_view, agents, obstacles.view());
      const detail::GapQuery query(best_implementation(), shapes_view, false);
      body.prepare(0, 20, infinity, detail::Look::nearest);
      std::size_t looked_at = 0;
      for (std::uint32_t i = 0; i < 20; ++i) {
        const auto nearest = query.find(body, i, infinity, 0, true);
        EXPECT_EQ(nearest.is_near_enough, is_area);
        looked_at = std::max(looked_at, body.near().found().size());
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

// ---- Obstacles with heights, against the definition: a body without heights, and the obstacles whose heights meet the body's, in a set of
// their own.

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// Gives obstacles, which have none, heights about those of agents: some reach the ground or the sky, some are planes at whole multiples of a quarter.
void raise(Random& random, ObstacleScene& scene) {
  for (std::size_t i = 0; i < scene.is_area.size(); ++i) {
    const double bottom = random.below(2) == 0 ? random.uniform(4, 8) : 4 + 0.25 * random.below(16);
    scene.bottom.push_back(random.below(4) == 0 ? -unlimited : bottom);
    scene.top.push_back(random.below(4) == 0 ? unlimited : bottom + 0.5 * random.below(3));
  }
}

/// Obstacles of a scene that are level with a body, without heights.
struct LevelObstacles {
  LevelObstacles(const ObstacleScene& scene, const std::vector<bool>& kept) {
    std::uint32_t number = 0;
    std::vector<std::uint64_t> obstacle_offsets{0}, path_offsets{0};
    std::vector<std::uint8_t> is_area;
    std::vector<double> x, y;
    for (std::size_t o = 0; o < scene.is_area.size(); ++o) {
      const std::size_t segments = scene.reference[o].segments.size();
      for (std::size_t k = 0; k < segments; ++k, ++number)
        if (kept[o]) numbers.push_back(number);
      if (!kept[o]) continue;
      obstacles.push_back(static_cast<std::uint32_t>(o)), reference.push_back(scene.reference[o]);
      for (std::size_t p = scene.obstacle_offsets[o]; p < scene.obstacle_offsets[o + 1]; ++p) {
        for (std::size_t i = scene.path_offsets[p]; i < scene.path_offsets[p + 1]; ++i)
          x.push_back(scene.x[i]), y.push_back(scene.y[i]);
        path_offsets.push_back(x.size());
      }
      obstacle_offsets.push_back(path_offsets.size() - 1), is_area.push_back(scene.is_area[o]);
    }
    set = std::make_unique<ObstacleSet>(ObstacleArrays{x, y, path_offsets, obstacle_offsets, is_area});
  }

  std::unique_ptr<ObstacleSet> set;
  std::vector<std::uint32_t> numbers, obstacles;  ///< in the whole scene, of its segments and obstacles
  std::vector<baselines::ReferenceObstacle> reference;
};

/// What all queries say of an agent.
struct AgentAnswers {
  std::uint8_t hit = 0, near = 0;
  float distance = HUGE_VALF, deepest = HUGE_VALF, time = HUGE_VALF;
  DiscPair discs{};
  Penetration way_out{};

  AgentAnswers() = default;
  AgentAnswers(const test::ObstacleAnswers& all, std::size_t i)
      : hit(all.hits[i]),
        near(all.near[i]),
        distance(all.distance[i]),
        deepest(all.deepest[i]),
        time(all.time[i]),
        discs(all.deepest_discs[i]),
        way_out(all.ways[i]) {}
};

/// What agents are asked: how near is near, and their ways, the same in x and y.
struct Question {
  detail::AllOptions options;
  std::vector<double> distances, way;

  test::ObstacleAnswers ask(const ShapeSet& set, const Agents& agents, const ObstacleSet& obstacles) const {
    return test::all_answers(set, agents, obstacles, options, distances, {way, way});
  }
};

class ObstaclesWithHeights : public testing::Test {
 protected:
  /// Returns what an agent says of the obstacles level with it. `touched`: those that it collides with.
  AgentAnswers expected_of(const Crowd& crowd, std::uint32_t agent, const ObstacleScene& scene,
                           const Question& question, std::vector<std::uint32_t>& touched) {
    const LevelObstacles level = level_with(scene, bodies[crowd.shape[agent]].heights, crowd.z[agent]);
    Crowd one;
    one.add({crowd.shape[agent], crowd.x[agent], crowd.y[agent], crowd.heading[agent], crowd.level[agent]});
    const Question its_own{
        question.options, {question.distances[agent]}, std::vector<double>(1, question.way[agent])};
    AgentAnswers of(its_own.ask(flat, one.agents(), *level.set), 0);
    EXPECT_EQ(of.hit, std::ranges::any_of(level.reference, [&](const auto& obstacle) {
                return reference.collides(one.agents(), 0, obstacle);
              }));
    if (of.deepest < HUGE_VALF) of.discs.second = level.numbers[of.discs.second];
    const Rows<std::uint32_t> rows =
        collider.obstacles(flat, one.agents(), *level.set, {.leaves = question.options.leaves});
    for (const std::uint32_t obstacle : rows[0]) touched.push_back(level.obstacles[obstacle]);
    return of;
  }

  Random random{3011};
  const ShapeSetPlan plan{.depths = {0, 3, all_depths}, .heights = true};
  const std::vector<Shape> bodies = test::bodies_with_heights(random);
  const ShapeSet set{bodies, plan};

 private:
  /// In long double, with the slack of the definition.
  static LevelObstacles level_with(const ObstacleScene& scene, Heights body, double z) {
    std::vector<bool> kept;
    const long double slack = 1e-9L + std::abs(z) * 0x1p-50L;
    for (std::size_t o = 0; o < scene.is_area.size(); ++o)
      kept.push_back(scene.bottom.empty() ||
                     (scene.bottom[o] <= static_cast<long double>(body.top) + z + slack &&
                      static_cast<long double>(body.bottom) + z <= scene.top[o] + slack));
    return {scene, kept};
  }

  const ShapeSet flat{bodies, {.depths = plan.depths}};
  ObstacleReference reference{bodies, {.depths = plan.depths}, Leaves::segments};
  bch::Crowd collider;
};

/// Obstacles of all heights, and the same ones raised.
TEST_F(ObstaclesWithHeights, AreAsWithoutHeightsWhereLevelWithABody) {
  constexpr std::uint32_t agents = 100;
  std::size_t hits = 0, passed = 0;
  for (std::uint32_t k = 0; k < test::samples(36); ++k) {
    ObstacleScene scene = test::obstacle_scene(random, 12, 3);
    Crowd crowd = test::crowd_about(random, set, agents, 3);
    Question question{{}, test::distances_for(random, agents), {}};
    question.options.distance_leaves = k % 2 == 0 ? Leaves::discs : Leaves::segments;
    for (std::uint32_t i = 0; i < agents; ++i) {
      crowd.z.push_back(random.below(3) == 0 ? 5 : random.uniform(3, 8));
      question.way.push_back(random.uniform(-1, 1));
    }
    std::vector<std::uint8_t> hits_of_all;
    for (const bool raised : {false, true}) {
      if (raised) raise(random, scene);
      const ObstacleSet obstacles = scene.set();
      const test::ObstacleAnswers found = question.ask(set, crowd.agents(), obstacles);
      bch::Crowd whole;
      const Rows<std::uint32_t> rows =
          whole.obstacles(set, crowd.agents(), obstacles, {.leaves = question.options.leaves});
      for (std::uint32_t i = 0; i < agents; ++i) {
        std::vector<std::uint32_t> touched;
        const AgentAnswers expected = expected_of(crowd, i, scene, question, touched), of(found, i);
        ASSERT_EQ(of.hit, expected.hit) << k << ", agent " << i;
        ASSERT_EQ(of.near, expected.near) << k << ", agent " << i;
        ASSERT_EQ(of.distance, expected.distance) << k << ", agent " << i;
        ASSERT_EQ(of.deepest, expected.deepest) << k << ", agent " << i;
        if (expected.deepest < HUGE_VALF) {
          ASSERT_EQ(of.discs, expected.discs) << k << ", agent " << i;
        }
        ASSERT_EQ(of.time, expected.time) << k << ", agent " << i;
        ASSERT_EQ(of.way_out, expected.way_out) << k << ", agent " << i;
        ASSERT_EQ(std::vector<std::uint32_t>(rows[i].begin(), rows[i].end()), touched);
        hits += expected.hit;
        passed += raised && hits_of_all[i] != 0 && expected.hit == 0;
      }
      hits_of_all = found.hits;
    }
  }
  EXPECT_GT(hits, test::samples(300));
  EXPECT_GT(passed, test::samples(150));
}

/// A box of a metre and a half beside a wall, on the ground and above it.
class BoxAtAWall : public testing::Test {
 protected:
  static ShapeSet box(bool heights) {
    Shape shape = test::synthetic_shapes(3012, 1).front();
    shape.heights = {0, 1.5f};
    return ShapeSet(std::vector<Shape>{shape}, {.heights = heights});
  }

  /// Asks for a collision with an area from `bottom` to `top` that holds the agent.
  static bool hits(const ShapeSet& set, const std::vector<double>& z, double bottom, double top) {
    const std::vector<double> x = {-50, 50, 50, -50}, y = {-50, -50, 50, 50};
    const std::vector<std::uint64_t> paths = {0, 4};
    const std::vector<std::uint8_t> area = {1};
    const std::vector<double> bottoms = {bottom}, tops = {top};
    const ObstacleSet obstacles({x, y, paths, {}, area, bottoms, tops});
    Crowd crowd;
    crowd.add({0, 1, 2, 0.5, 0});
    crowd.z = z;
    std::uint8_t hit = 0;
    collide(set, crowd.agents(), obstacles, {&hit, 1});
    float time = 0;
    const std::vector<double> still = {0};
    time_of_impact(set, crowd.agents(), {still, still}, obstacles, {&time, 1});
    EXPECT_EQ(time == 0, hit != 0);
    return hit != 0;
  }
};

TEST_F(BoxAtAWall, MeetsWhatTouchesItsHeights) {
  const ShapeSet set = box(true);
  EXPECT_TRUE(hits(set, {}, 1.5, 3));
  EXPECT_FALSE(hits(set, {}, 1.5 + 1e-8, 3));
  EXPECT_TRUE(hits(set, {10}, 11.5, 13));
  EXPECT_FALSE(hits(set, {10}, 11.5 + 1e-8, 13));
  EXPECT_TRUE(hits(set, {10}, 2, 10));
  EXPECT_FALSE(hits(set, {10}, 2, 10 - 1e-8));
  EXPECT_FALSE(hits(set, {500}, -unlimited, 3));
  EXPECT_TRUE(hits(set, {500}, 3, unlimited));
  EXPECT_TRUE(hits(set, {500}, -unlimited, unlimited));
  // As between agents, what is rounded far above counts as touching.
  EXPECT_TRUE(hits(set, {1e9}, 1e9 + 1.5 + 5e-7, unlimited));
  EXPECT_FALSE(hits(set, {1e9}, 1e9 + 1.5 + 2e-6, unlimited));
}

TEST_F(BoxAtAWall, WithoutHeightsMeetsWallsOfAllHeights) {
  EXPECT_TRUE(hits(box(false), {}, 500, 501));
}

}  // namespace
}  // namespace bch
