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
  for (const Semantics semantics : {Semantics::boundary, Semantics::solid}) {
    std::vector<std::uint8_t> expected, hits(pairs);
    for (const Pair pair : scene.pairs)
      expected.push_back(semantics == Semantics::boundary
                             ? reference.boundary(agents, pair, baselines::Method::brute_force)
                             : reference.solid(agents, pair, baselines::Method::brute_force));
    for (std::uint32_t i = 0; i < pairs; ++i) EXPECT_TRUE(expected[i] == 1 || !crossing[i]) << i;
    for (const auto& implementation : implementations()) {
      if (!implementation.supported()) continue;
      collide(set, agents, scene.pairs, hits, {semantics, &implementation});
      EXPECT_EQ(hits, expected) << implementation.name;
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

}  // namespace
}  // namespace bch
