// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <bch/collide.hpp>
#include <bch/crowd.hpp>
#include <bch/pose_shape.hpp>
#include <bch/shape_set_builder.hpp>

#include "baselines/slab_bodies.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/crowd_pairs.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/slab_scenes.hpp"
#include "tests/support/test_characters.hpp"

// Bodies in slabs, and at different heights, against the definition: every pair of parts by brute force.

namespace bch {
namespace {

using baselines::Method;
using baselines::SlabBodies;
using test::bodies;
using test::eight_slabs;
using test::levels_of;
using test::PairScene;
using test::raise;
using test::Random;
using test::three_slabs;

std::vector<std::uint8_t> answers(const ShapeSet& set, const PairScene& scene,
                                  const QueryOptions& options = {}) {
  std::vector<std::uint8_t> hits(scene.pairs.size(), 77);
  collide(set, scene.crowd.agents(), scene.pairs, hits, options);
  return hits;
}

void expect_equal_to_brute_force(const ShapeSet& set, const SlabBodies& reference, const PairScene& scene,
                                 Leaves leaves = Leaves::segments) {
  const Agents agents = scene.crowd.agents();
  std::vector<std::uint8_t> expected;
  for (const Pair& pair : scene.pairs)
    expected.push_back(reference.collide(agents, pair, Method::brute_force));
  const auto hits = std::count(expected.begin(), expected.end(), 1);
  EXPECT_GT(hits, std::ssize(expected) / 20);
  EXPECT_LT(hits, std::ssize(expected) * 19 / 20);
  for (const auto& implementation : implementations()) {
    if (!implementation.supported()) continue;
    const auto found = answers(set, scene, {.implementation = &implementation, .leaves = leaves});
    for (std::size_t i = 0; i < expected.size(); ++i)
      ASSERT_EQ(found[i], expected[i]) << implementation.name << ", pair " << i << ": shapes "
                                       << agents.shape[2 * i] << " and " << agents.shape[2 * i + 1];
  }
}

class Slabs : public testing::TestWithParam<std::vector<float>> {
 protected:
  Random random{20261};
  ShapeSetPlan plan = levels_of(GetParam());
  std::vector<Shape> shapes = bodies(random, plan);
  ShapeSet set{shapes, plan};
  SlabBodies reference{shapes, plan};
};

INSTANTIATE_TEST_SUITE_P(Three, Slabs, testing::Values(three_slabs));
INSTANTIATE_TEST_SUITE_P(Eight, Slabs, testing::Values(eight_slabs));
INSTANTIATE_TEST_SUITE_P(Two, Slabs, testing::Values(std::vector<float>{0.6f}));

TEST_P(Slabs, EqualBruteForce) {
  expect_equal_to_brute_force(set, reference, random_scene(random, set, 20'000));
}

TEST_P(Slabs, EqualBruteForceAtHeights) {
  PairScene scene = random_scene(random, set, 20'000);
  raise(random, scene);
  expect_equal_to_brute_force(set, reference, scene);
}

TEST_P(Slabs, EqualBruteForceNearTangent) {
  PairScene scene = random_scene(random, set, test::samples(4'000));
  make_tangent(random, scene, [&](const Agents& agents, Pair pair) {
    return reference.collide(agents, pair, Method::depth_first);
  });
  expect_equal_to_brute_force(set, reference, scene);
}

TEST_P(Slabs, EqualBruteForceWithDiscs) {
  expect_equal_to_brute_force(set, SlabBodies(shapes, plan, Leaves::discs), random_scene(random, set, 10'000),
                              Leaves::discs);
}

TEST_P(Slabs, EqualBruteForceWithoutCulling) {
  const ShapeSet plain(shapes, levels_of(GetParam(), false));
  expect_equal_to_brute_force(plain, reference, random_scene(random, plain, 10'000));
}

TEST_P(Slabs, ADeeperLevelNeverAddsACollision) {
  PairScene scene = random_scene(random, set, 20'000);
  std::vector<std::uint8_t> before(scene.pairs.size(), 1);
  for (std::uint8_t level = 0; level < set.level_count(); ++level) {
    std::fill(scene.crowd.level.begin(), scene.crowd.level.end(), level);
    const auto now = answers(set, scene);
    for (std::size_t i = 0; i < now.size(); ++i) ASSERT_LE(now[i], before[i]) << i;
    before = now;
  }
}

TEST_P(Slabs, AnySplitOrderAndNumberOfThreadsGivesTheSame) {
  PairScene scene = random_scene(random, set, 20'000);
  raise(random, scene);
  const auto expected = answers(set, scene);
  for (const int threads : {1, 2, 7}) {
    tbb::task_arena arena(threads);
    EXPECT_EQ(arena.execute([&] { return answers(set, scene); }), expected);
  }
  std::vector<std::uint8_t> found(expected.size(), 77);
  const std::span<const Pair> pairs = scene.pairs;
  for (std::size_t begin = 0; begin < pairs.size();) {
    const std::size_t size = std::min<std::size_t>(1 + random.below(700), pairs.size() - begin);
    collide(set, scene.crowd.agents(), pairs.subspan(begin, size), std::span(found).subspan(begin, size));
    begin += size;
  }
  EXPECT_EQ(found, expected);
  for (auto& [first, second] : scene.pairs) std::swap(first, second);
  EXPECT_EQ(answers(set, scene), expected);
}

TEST_P(Slabs, FarFromTheOriginTheAnswerIsTheSame) {
  PairScene scene = random_scene(random, set, 20'000);
  const auto expected = answers(set, scene);
  test::move_away(scene, 1e7, -8e8);
  EXPECT_EQ(answers(set, scene), expected);
}

/// Slices leave collisions out and add none, for exact outlines: those of slabs lie in the whole one.
TEST_P(Slabs, CollideWhereWholeBodiesDo) {
  std::vector<Shape> whole, cut;
  for (const Character& character : test::default_characters()) {
    PoseShaper as_whole(character), in_slabs(character, plan);
    for (const PoseTime& time : sample_poses(character, 20)) {
      whole.push_back(as_whole.shape(time));
      cut.push_back(in_slabs.shape(time));
    }
  }
  const ShapeSet whole_set(whole), cut_set(cut, {.slices = GetParam()});
  PairScene scene = random_scene(random, whole_set, 20'000);
  const auto of_whole = answers(whole_set, scene, {}), of_slabs = answers(cut_set, scene);
  std::size_t fewer = 0;
  for (std::size_t i = 0; i < of_slabs.size(); ++i) {
    ASSERT_LE(of_slabs[i], of_whole[i]) << i;
    fewer += of_slabs[i] < of_whole[i];
  }
  EXPECT_GT(fewer, of_slabs.size() / 100);
}

/// What a frame does: shapes one by one into another set, some into places that are too small.
TEST_P(Slabs, OfADynamicSetAreThoseOfASet) {
  std::vector<Shape> turned = shapes;
  std::rotate(turned.begin(), turned.begin() + 5, turned.end());
  DynamicShapeSet dynamic{ShapeSet(turned, plan)};
  EXPECT_EQ(dynamic.set().plan(), set.plan());
  PreparedShape prepared(plan);
  std::size_t refused = 0;
  for (std::uint32_t i = 0; i < shapes.size(); ++i) {
    prepared.prepare(shapes[i], i);
    if (dynamic.try_replace(i, prepared)) continue;
    dynamic.replace(i, prepared);
    ++refused;
  }
  EXPECT_GT(refused, 0u);
  PairScene scene = random_scene(random, set, 20'000);
  raise(random, scene);
  EXPECT_EQ(answers(dynamic.set(), scene), answers(set, scene));
  EXPECT_EQ(answers(ShapeSet(DynamicShapeSet(dynamic.set()).set().arrays(), nullptr), scene),
            answers(set, scene));
}

TEST_P(Slabs, AreFoundByTheBroadPhase) {
  test::Crowd crowd;
  for (int i = 0; i < 600; ++i)
    crowd.add({random.below(set.shape_count()), random.uniform(0, 8), random.uniform(0, 8),
               random.uniform(-4, 4), static_cast<std::uint8_t>(random.below(3))});
  for (const bool heights : {false, true}) {
    if (heights)
      for (std::size_t i = 0; i < crowd.x.size(); ++i)
        crowd.z.push_back(3.0 * random.below(4) + random.uniform(0, 0.5));
    const Agents agents = crowd.agents();
    std::vector<Pair> all;
    for (std::uint32_t a = 0; a < agents.size(); ++a)
      for (std::uint32_t b = a + 1; b < agents.size(); ++b) all.push_back({a, b});
    std::vector<std::uint8_t> hits(all.size());
    collide(set, agents, all, hits);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> expected, found;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (hits[i] != 0) expected.emplace_back(all[i].first, all[i].second);
    bch::Crowd collider;
    for (const auto [a, b] : collider.collisions(set, agents)) found.emplace_back(a, b);
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
    EXPECT_GT(expected.size(), 50u);
    if (!heights) continue;
    // Floors are three metres apart, and nobody is as tall as that but those without a top.
    const std::size_t on_floors = test::candidate_pairs(set, agents).size();
    test::Crowd flat = crowd;
    flat.z.clear();
    EXPECT_LT(on_floors, test::candidate_pairs(set, flat.agents()).size() / 2);
  }
}

/// Whole bodies with heights: they collide as without, where their heights meet.
TEST(Heights, OfWholeBodiesHaveToMeet) {
  Random random(20262);
  const ShapeSetPlan plan{.depths = {0, 3, all_depths}, .heights = true};
  const std::vector<Shape> shapes = bodies(random, {.heights = true});
  const ShapeSet set(shapes, plan);
  PairScene scene = random_scene(random, set, 10'000);
  const auto on_one_ground = answers(set, scene, {});
  raise(random, scene);
  const SlabBodies reference(shapes, plan);
  const Agents agents = scene.crowd.agents();
  const auto found = answers(set, scene, {});
  std::size_t above = 0;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    ASSERT_EQ(found[i], reference.collide(agents, scene.pairs[i], Method::brute_force)) << i;
    above += found[i] < on_one_ground[i];
  }
  EXPECT_GT(above, 50u);
}

TEST(Heights, OfBodiesThatTouchMeet) {
  Shape box;
  box.outline = test::polygon({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});
  box.hierarchy = contour_hierarchy(box.outline, 0.1f);
  box.heights = {0, 1.5f};
  const ShapeSet set(std::vector<Shape>{box}, {.heights = true});
  PairScene scene;
  scene.crowd.add({0, 0, 0, 0, 0}), scene.crowd.add({0, 0.5, 0, 0, 0});
  scene.pairs = {{0, 1}};
  for (const auto& [z, hit] : {std::pair(1.5, 1), {1.5 + 1e-6, 0}, {-1.5, 1}, {-1.6, 0}}) {
    scene.crowd.z = {1e6, 1e6 + z};
    EXPECT_EQ(answers(set, scene)[0], hit) << z;
  }
}

TEST(Slices, RejectsWhatIsWrong) {
  const auto complaint = [](const ShapeSetPlan& plan, const std::vector<Shape>& shapes = {}) {
    return test::complaint([&] { ShapeSet(shapes, plan); });
  };
  EXPECT_EQ(complaint({.slices = {1, 0.5f}}), "slices: plane 1 at 0.5 m does not ascend");
  EXPECT_EQ(complaint({.outlines = false, .slices = {1}}), "slices: they need outlines");
  EXPECT_EQ(complaint({.slices = std::vector<float>(64, 1)}), "slices: 64 planes, more than 63");
  Random random(1);
  const std::vector<Shape> cut_shapes = bodies(random, levels_of(three_slabs));
  EXPECT_EQ(complaint(levels_of(eight_slabs), cut_shapes),
            "shape set: shape 0: slices: 3 slabs for 7 planes");
  std::vector<Shape> empty(1);
  empty[0].slabs.resize(2);
  EXPECT_EQ(complaint({.slices = {1}}, empty), "shape set: shape 0: slices: all slabs are empty");
  std::vector<Shape> upside_down = {cut_shapes.back()};
  upside_down[0].heights = {1, 0};
  EXPECT_EQ(complaint({.slices = {1}}, upside_down), "shape set: shape 0: heights: from 1 to 0 m");
  std::vector<Shape> low(2);  // what is in a slab was compared with nothing
  for (Shape& body : low)
    body.slabs = {{}, {}, test::contour_shape(test::polygon({{0, 0}, {1, 0}, {0, 1}}), 0.1f)};
  EXPECT_EQ(complaint({.slices = {0.4f, 1}}, low), "accepted");
  low[1].heights = {0, 0.2f};
  EXPECT_EQ(
      complaint({.slices = {0.4f, 1}}, low),
      "shape set: shape 1: slab 2 is not empty, and the body's heights, from 0 to 0.2 m, do not reach it");
  const Disc disc{0, 0, 0.2f};
  const std::vector<Shape> of_discs = {cut_shapes[0], shape_from_discs({&disc, 1})};
  EXPECT_EQ(complaint(levels_of(three_slabs), of_discs),
            "shape set: shape 1: slices: it has no outline, which slabs need, unless depth 0 is alone");
  EXPECT_EQ(complaint({.depths = {0}, .slices = three_slabs}, of_discs), "accepted");

  const ShapeSet flat(std::vector<Shape>{cut_shapes.back()}), cut(cut_shapes, levels_of(three_slabs));
  PairScene scene;
  scene.crowd.add({0, 0, 0, 0, 0}), scene.crowd.add({0, 0, 0, 0, 0});
  scene.pairs = {{0, 1}};
  scene.crowd.z = {0, 0};
  EXPECT_EQ(test::complaint([&] { answers(flat, scene); }),
            "agents: they have a z, and the set was planned without heights");
  scene.crowd.z = {0, NAN};
  EXPECT_EQ(test::complaint([&] { answers(cut, scene); }), "pair 0: agent 1: z nan m is not within +-1e9");
  scene.crowd.z = {0};
  EXPECT_EQ(test::complaint([&] { answers(cut, scene); }), "agents: 2 shapes but 1 values of z");
}

TEST(Slices, SayWhereTheirDiscsAre) {
  Random random(2);
  const ShapeSetPlan plan = levels_of(three_slabs);
  const std::vector<Shape> shapes = bodies(random, plan);
  const ShapeSet set(shapes, plan);
  for (std::uint32_t s = 0; s < set.shape_count(); ++s) {
    const auto discs = set.discs(s, 2);
    const auto begin = set.slab_begin(s, 2);
    ASSERT_EQ(begin.size(), 4u);
    EXPECT_EQ(begin.back(), discs.size());
    std::size_t at = 0;
    const auto expect = [&](const Shape& part) {
      for (const std::uint32_t node : cut(part.hierarchy, all_depths))
        EXPECT_EQ(discs[at++], part.hierarchy.nodes[node].disc);
    };
    if (shapes[s].slabs.empty()) expect(shapes[s]);
    for (std::size_t slab = 0; slab < shapes[s].slabs.size(); ++slab) {
      EXPECT_EQ(begin[slab], at);
      if (!shapes[s].slabs[slab].hierarchy.nodes.empty()) expect(shapes[s].slabs[slab]);
    }
    EXPECT_EQ(at, discs.size());
  }
}

}  // namespace
}  // namespace bch
