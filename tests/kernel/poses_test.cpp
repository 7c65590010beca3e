// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <bch/collide.hpp>
#include <bch/default_characters.hpp>
#include <bch/outline_builder.hpp>

#include "baselines/oracle.hpp"
#include "baselines/reference.hpp"
#include "layout/character/skinning.hpp"
#include "tests/support/character_shapes.hpp"
#include "tests/support/hierarchy_checks.hpp"
#include "tests/support/outline_checks.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/test_characters.hpp"

// The whole way from a character to answers, on all default poses and on real characters.

namespace bch {
namespace {

/// Two outlines in a relative placement bisected to where they begin to cross: no kernel may miss the
/// crossing.
void expect_no_crossing_missed(const std::vector<Character>& characters, std::uint32_t poses,
                               std::uint32_t pairs) {
  std::vector<Shape> shapes;
  for (const Character& character : characters)
    for (Shape& shape : test::pose_shapes(character, poses)) shapes.push_back(std::move(shape));
  const ShapeSetPlan plan{{0, 3, 6, all_depths}, true};
  const ShapeSet set(shapes, plan);
  const baselines::Reference reference(shapes, plan);
  test::Random random(2014);

  const auto crosses = [&](const Agents& agents, Pair pair) {
    return baselines::Oracle(shapes[agents.shape[pair.first]].outline,
                             shapes[agents.shape[pair.second]].outline,
                             baselines::exact_placement(agents, pair.first, pair.second))
        .cross();
  };
  pairs = test::samples(pairs);
  test::PairScene scene = random_scene(random, set, pairs);
  for (std::uint32_t i = 0; i < pairs; ++i)
    scene.crowd.shape[2 * i] = i % set.shape_count();  // every pose takes part
  make_tangent(random, scene, crosses);

  const Agents agents = scene.crowd.agents();
  std::vector<bool> crossing;
  for (const Pair& pair : scene.pairs) crossing.push_back(crosses(agents, pair));
  EXPECT_GT(std::count(crossing.begin(), crossing.end(), true), std::ssize(crossing) / 3);
  for (const auto& implementation : implementations()) {
    if (!implementation.supported()) continue;
    for (const Semantics semantics : {Semantics::boundary, Semantics::solid}) {
      std::vector<std::uint8_t> hits(pairs);
      collide(set, agents, scene.pairs, hits, {semantics, &implementation});
      for (std::uint32_t i = 0; i < pairs; ++i) {
        EXPECT_TRUE(hits[i] == 1 || !crossing[i]) << implementation.name << " misses pair " << i;
        const bool expected = semantics == Semantics::boundary
                                  ? reference.boundary(agents, scene.pairs[i], baselines::Method::brute_force)
                                  : reference.solid(agents, scene.pairs[i], baselines::Method::brute_force);
        ASSERT_EQ(hits[i] == 1, expected) << implementation.name << ", pair " << i;
      }
    }
  }
}

TEST(DefaultPoses, NoOutlineCrossingIsMissed) {
  expect_no_crossing_missed(test::default_characters(), 100, 2000);
}

TEST(RealPoses, NoOutlineCrossingIsMissed) {
  const auto data = test::test_data();
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set: no real characters to test with";
  expect_no_crossing_missed(test::real_characters(*data), 50, 2000);
}

/// Outline against sampling, hierarchy against the mesh, for some poses.
void expect_sound_poses(const std::vector<Character>& characters, std::uint32_t poses) {
  for (const Character& character : characters) {
    detail::Skinner skinner(character);
    for (const PoseTime& time : sample_poses(character, poses)) {
      SCOPED_TRACE(character.name + ", clip " + std::to_string(time.clip) + ", " +
                   std::to_string(time.seconds) + " s");
      const auto positions = skinner.pose(time);
      const Outline outline = union_outline(positions, character.triangles);
      test::expect_covers(outline, positions, character.triangles);
      test::expect_equals_samples(outline, positions, character.triangles, 120);

      const Hierarchy contour = contour_hierarchy(outline, 0.01f);
      test::expect_sound(contour);
      test::expect_covers_outline(contour, outline);
      test::expect_leaves_below(contour, 0.01f);
      const Disc& root = contour.nodes[0].disc;
      std::vector<Vec2> vertices;
      for (const auto& p : positions) {
        vertices.push_back({p.x, p.y});
        EXPECT_LE(std::hypot(static_cast<double>(p.x) - static_cast<double>(root.x),
                             static_cast<double>(p.y) - static_cast<double>(root.y)),
                  root.radius);
      }
      test::expect_sound(projected_hierarchy(vertices, character.triangles));
    }
  }
}

TEST(DefaultPoses, OutlinesAndHierarchiesAreSound) {
  expect_sound_poses(test::default_characters(), 6);
}

TEST(RealPoses, OutlinesAndHierarchiesAreSound) {
  const auto data = test::test_data();
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set: no real characters to test with";
  expect_sound_poses(test::real_characters(*data), 6);
}

/// Poses shrunk to an eighth, up to 0.3 m along x and y from where others stand: solid sees all that lie inside
/// without crossing the outline, boundary only those that are nearer to it than leaf discs are large.
TEST(DefaultPoses, SolidSeesAPersonInsideAPerson) {
  std::vector<Shape> shapes = test::pose_shapes(default_male(), 8);
  const std::size_t count = shapes.size();
  for (std::size_t i = 0; i < count; ++i) {
    Outline small = shapes[i].outline;
    for (Vec2& p : small.points) p = {0.125f * p.x, 0.125f * p.y};
    small.grid_step *= 0.125f;
    shapes.push_back(test::contour_shape(small));
  }
  const ShapeSet set(shapes, {{all_depths}, true});
  test::Crowd crowd;
  std::vector<Pair> pairs;
  test::Random random(8);
  for (std::uint32_t i = 0; i < 3000; ++i) {
    crowd.add({random.below(static_cast<std::uint32_t>(count)), 0, 0, random.uniform(-3, 3), 0});
    crowd.add({static_cast<std::uint32_t>(count) + random.below(static_cast<std::uint32_t>(count)),
               random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(-3, 3), 0});
    pairs.push_back({2 * i, 2 * i + 1});
  }
  const Agents agents = crowd.agents();
  constexpr double across_two_leaves = 0.04;  // metres
  std::size_t found = 0, seen_at_the_edge = 0;
  std::vector<std::uint8_t> solid(pairs.size()), boundary(pairs.size());
  collide(set, agents, pairs, solid, {Semantics::solid});
  collide(set, agents, pairs, boundary, {Semantics::boundary});
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const baselines::Oracle oracle(shapes[crowd.shape[2 * i]].outline, shapes[crowd.shape[2 * i + 1]].outline,
                                   baselines::exact_placement(agents, pairs[i].first, pairs[i].second));
    if (oracle.cross() || !oracle.nested()) continue;
    ++found;
    EXPECT_EQ(solid[i], 1) << i;
    if (boundary[i] == 0) continue;
    ++seen_at_the_edge;
    EXPECT_LT(oracle.distance(), across_two_leaves) << i;
  }
  EXPECT_GT(found, 100u);
  EXPECT_LT(seen_at_the_edge, found / 3);
}

}  // namespace
}  // namespace bch
