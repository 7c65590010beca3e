// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/character_shapes.hpp"
#include "tests/support/obstacle_scenes.hpp"
#include "tests/support/test.hpp"

// Obstacles with heights, against the definition: a body without heights, and the obstacles whose heights meet the body's, in a set of
// their own.

namespace bch {
namespace {

using baselines::ObstacleReference;
using test::Crowd;
using test::ObstacleScene;
using test::Random;

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
  LevelObstacles(const ObstacleScene& scene, const std::function<bool(std::size_t)>& is_level) {
    std::uint32_t number = 0;
    for (std::uint32_t o = 0; o < scene.is_area.size(); ++o) {
      const bool kept = is_level(o);
      if (kept) obstacles.push_back(o);
      for (std::size_t k = scene.reference[o].segments.size(); k > 0; --k, ++number)
        if (kept) numbers.push_back(number);
    }
    part = scene.part(obstacles);
  }

  std::vector<std::uint32_t> numbers, obstacles;  ///< in the whole scene, of its segments and obstacles
  ObstacleScene part;
};

/// What agents are asked: how near is near, and their ways, the same in x and y.
struct Question {
  detail::AllOptions options;
  std::vector<double> distances, way;

  test::ObstacleAnswers run_query(const ShapeSet& set, const Agents& agents,
                                  const ObstacleSet& obstacles) const {
    return test::all_answers(set, agents, obstacles, options, distances, {way, way});
  }
};

class ObstaclesWithHeights : public testing::Test {
 protected:
  /// Returns what an agent says of the obstacles level with it. `touched`: those that it collides with.
  test::ObstacleAnswers expected_of(const Crowd& crowd, std::uint32_t agent, const ObstacleScene& scene,
                                    const Question& question, std::vector<std::uint32_t>& touched) {
    const LevelObstacles level = level_with(scene, bodies[crowd.shape[agent]].heights, crowd.z[agent]);
    Crowd one;
    one.add({crowd.shape[agent], crowd.x[agent], crowd.y[agent], crowd.heading[agent], crowd.level[agent]});
    const Question its_own{
        question.options, {question.distances[agent]}, std::vector<double>(1, question.way[agent])};
    const ObstacleSet obstacles = level.part.set();
    test::ObstacleAnswers of = its_own.run_query(flat, one.agents(), obstacles);
    EXPECT_EQ(of.hits[0], std::ranges::any_of(level.part.reference, [&](const auto& obstacle) {
                return reference.collides(one.agents(), 0, obstacle);
              }));
    std::uint32_t& segment = of.deepest_discs[0].second;
    if (of.deepest[0] < HUGE_VALF) segment = level.numbers[segment];
    const Rows<std::uint32_t> rows =
        collider.obstacles(flat, one.agents(), obstacles, {.leaves = question.options.leaves});
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
    const long double slack = 1e-9L + std::abs(z) * 0x1p-50L;
    return {scene, [&](std::size_t o) {
              return scene.bottom.empty() ||
                     (scene.bottom[o] <= static_cast<long double>(body.top) + z + slack &&
                      static_cast<long double>(body.bottom) + z <= scene.top[o] + slack);
            }};
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
      const test::ObstacleAnswers found = question.run_query(set, crowd.agents(), obstacles);
      bch::Crowd whole;
      const Rows<std::uint32_t> rows =
          whole.obstacles(set, crowd.agents(), obstacles, {.leaves = question.options.leaves});
      for (std::uint32_t i = 0; i < agents; ++i) {
        std::vector<std::uint32_t> touched;
        const test::ObstacleAnswers expected = expected_of(crowd, i, scene, question, touched);
        ASSERT_EQ(found.hits[i], expected.hits[0]) << k << ", agent " << i;
        ASSERT_EQ(found.near[i], expected.near[0]) << k << ", agent " << i;
        ASSERT_EQ(found.distance[i], expected.distance[0]) << k << ", agent " << i;
        ASSERT_EQ(found.deepest[i], expected.deepest[0]) << k << ", agent " << i;
        if (expected.deepest[0] < HUGE_VALF) {
          ASSERT_EQ(found.deepest_discs[i], expected.deepest_discs[0]) << k << ", agent " << i;
        }
        ASSERT_EQ(found.time[i], expected.time[0]) << k << ", agent " << i;
        ASSERT_EQ(found.ways[i], expected.ways[0]) << k << ", agent " << i;
        ASSERT_EQ(std::vector<std::uint32_t>(rows[i].begin(), rows[i].end()), touched);
        hits += found.hits[i];
        passed += raised && hits_of_all[i] != 0 && found.hits[i] == 0;
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
    const ObstacleSet obstacles =
        obstacles_from_wkt("POLYGON((-50 -50, 50 -50, 50 50, -50 50))", Polygons::solid, bottom, top);
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
