// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/oracle.hpp"
#include "baselines/reference.hpp"
#include "tests/support/character_shapes.hpp"
#include "tests/support/test.hpp"
#include "tests/support/test_characters.hpp"

// The whole way from a character to answers, on all default poses and on real characters.

namespace bch {
namespace {

/// Two outlines in a relative placement bisected to where they begin to cross: no kernel may miss the
/// crossing.
void expect_no_crossing_missed(const std::vector<Shape>& shapes, std::uint32_t pairs) {
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
  std::vector<std::uint8_t> expected, hits(pairs);
  for (const Pair pair : scene.pairs)
    expected.push_back(reference.solid(agents, pair, baselines::Method::brute_force));
  for (std::uint32_t i = 0; i < pairs; ++i) EXPECT_TRUE(expected[i] == 1 || !crossing[i]) << i;
  for (const Implementation& implementation : test::supported()) {
    collide(set, agents, scene.pairs, hits, {&implementation});
    EXPECT_EQ(hits, expected) << implementation.name;
  }
}

std::vector<Shape> poses_of(const std::vector<Character>& characters, std::uint32_t poses) {
  std::vector<Shape> shapes;
  for (const Character& character : characters)
    for (Shape& shape : test::pose_shapes(character, poses)) shapes.push_back(std::move(shape));
  return shapes;
}

TEST(SyntheticShapes, NoOutlineCrossingIsMissed) {
  expect_no_crossing_missed(test::synthetic_shapes(20141, 40), 1500);
}

TEST(DefaultPoses, NoOutlineCrossingIsMissed) {
  expect_no_crossing_missed(poses_of(test::default_characters(), 100), 2000);
}

TEST(RealPoses, NoOutlineCrossingIsMissed) {
  const auto data = test::test_data();
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set: no real characters to test with";
  expect_no_crossing_missed(poses_of(test::real_characters(*data), 50), 2000);
}

}  // namespace
}  // namespace bch
