// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/reference.hpp"

#include <cinttypes>
#include <cstdio>

#include "baselines/contact_reference.hpp"
#include "baselines/disc_tree.hpp"
#include "baselines/oracle.hpp"
#include "baselines/placement.hpp"
#include "baselines/time_of_impact_reference.hpp"
#include "tests/support/baseline_scene.hpp"
#include "tests/support/test.hpp"
#include "tests/support/test_characters.hpp"

// The answer at every depth, by all who give it without the kernel: its definition, the descent that verifies, and the
// fast one. What must hold of it: nothing is missed, and a deeper cut adds no collision.

namespace bch {
namespace {

using baselines::Body;
using baselines::Method;
using baselines::Structure;
using baselines::TestCounts;
using test::PairScene;

constexpr std::uint32_t deepest = 14;
/// 1 of so many pairs goes to what is slower still.
constexpr std::size_t slow_stride = 8;

std::vector<std::uint32_t> all_levels() {
  std::vector<std::uint32_t> depths;
  for (std::uint32_t depth = 0; depth <= deepest; ++depth) depths.push_back(depth);
  depths.push_back(all_depths);
  return depths;
}

std::vector<Shape> shapes_of(std::span<const Body> bodies) {
  std::vector<Shape> shapes;
  for (const Body& body : bodies) shapes.push_back(body.shape);
  return shapes;
}

std::vector<Body> synthetic_bodies(std::uint64_t seed, std::uint32_t count) {
  std::vector<Body> bodies;
  for (const Shape& shape : test::synthetic_shapes(seed, count)) bodies.push_back({{}, {}, shape});
  return bodies;
}

class Answers {
 public:
  explicit Answers(std::vector<Body> of) : bodies(std::move(of)) {
    const bool outlined = bodies[0].shape.outline.points.size() > 0;
    if (outlined) outlines = baselines::kind("obb_contour_2d").build(bodies, {});
  }

  /// Slides every second agent to where the answer at some depth changes, that of the descent alone, or the outlines'.
  void bring_to_contact(std::uint64_t seed, PairScene& scene) const {
    if (test::replaying()) return;
    test::Random random(seed);
    make_tangent(random, scene, [&](const Agents& agents, Pair pair) {
      const Structure* const structures[] = {fast.get(), descent.get(), outlines.get()};
      const std::size_t i = pair.first / 2;
      const bool of_outlines = i % 3 == 2;
      return structures[i % 3]->query(agents, pair,
                                      of_outlines ? all_depths : plan.depths[i / 3 % plan.depths.size()]);
    });
  }

  void expect_in_order(PairScene& scene, std::uint64_t seed) {
    const std::size_t count = scene.pairs.size();
    std::vector<std::uint8_t> crossing(count), before(count, 1), hits(count), met(count);
    outlines->query(scene.crowd.agents(), scene.pairs, crossing);
    std::size_t refuted = 0;
    for (std::size_t level = 0; level < plan.depths.size(); ++level) {
      std::fill(scene.crowd.level.begin(), scene.crowd.level.end(), static_cast<std::uint8_t>(level));
      const Agents agents = scene.crowd.agents();
      fast->query(agents, scene.pairs, hits, plan.depths[level]);
      descent->query(agents, scene.pairs, met, plan.depths[level]);
      for (std::size_t i = 0; i < count; ++i) {
        SCOPED_TRACE("level " + std::to_string(level) + ", " + test::replay_line(scene, i));
        ASSERT_EQ(hits[i], slow.boundary(agents, scene.pairs[i], Method::depth_first));
        ASSERT_LE(hits[i], before[i]) << "a deeper cut adds a collision";
        ASSERT_LE(hits[i], met[i]) << "the descent misses a hit";
        ASSERT_GE(hits[i], crossing[i]) << "outlines that meet are missed";
        const bool exact_hit = exact.boundary(agents, scene.pairs[i], Method::depth_first);
        ASSERT_LE(exact_hit, hits[i] != 0) << "exact leaves add a collision";
        ASSERT_GE(exact_hit, crossing[i] != 0) << "exact leaves miss outlines that meet";
        if (plan.depths[level] == all_depths) {
          ASSERT_EQ(segments->query(agents, scene.pairs[i]),
                    exact.solid(agents, scene.pairs[i], Method::depth_first));
        }
        if (i % slow_stride == 0) check_slowly(agents, scene.pairs[i], hits[i] == 1);
        refuted += hits[i] != met[i];
      }
      before = hits;
    }
    std::printf("seed %" PRIu64 ": %zu pairs, %td hits at all depths, %td crossings, %zu hits refuted\n",
                seed, count, std::count(hits.begin(), hits.end(), 1),
                std::count(crossing.begin(), crossing.end(), 1), refuted);
    if (test::replaying()) return;
    EXPECT_GT(refuted, 0u);
    EXPECT_GT(std::count(hits.begin(), hits.end(), 1), std::ssize(hits) / 10);
    EXPECT_LT(std::count(hits.begin(), hits.end(), 1), std::ssize(hits) * 9 / 10);
  }

  std::vector<Body> bodies;
  std::vector<Shape> shapes = shapes_of(bodies);
  ShapeSetPlan plan{all_levels()};
  std::unique_ptr<Structure> fast = baselines::kind("reference").build(bodies, {}),
                             descent = baselines::kind("paper_descent").build(bodies, {}),
                             segments = baselines::kind("reference_segments").build(bodies, {}), outlines;

 private:
  void check_slowly(const Agents& agents, Pair pair, bool hit) const {
    const auto [a, b] = pair;
    ASSERT_EQ(slow.boundary(agents, pair, Method::brute_force), hit);
    ASSERT_NE(baselines::contacts(cuts_, agents, pair).empty(), hit);
    const baselines::Oracle oracle(shapes[agents.shape[a]].outline, shapes[agents.shape[b]].outline,
                                   baselines::exact_placement(agents, a, b));
    ASSERT_TRUE(hit || !oracle.cross());
  }

  baselines::Reference slow{shapes, plan, Leaves::discs}, exact{shapes, plan};
  baselines::CutLists cuts_{shapes, plan};
};

/// Pairs at random, and pairs that are brought to contact.
void expect_answers_in_order(std::uint64_t seed, std::vector<Body> bodies, std::uint32_t pairs) {
  Answers answers(std::move(bodies));
  PairScene random = test::placements(seed, answers.bodies, pairs);
  ASSERT_NO_FATAL_FAILURE(answers.expect_in_order(random, seed));
  PairScene tangent = test::placements(seed + 1, answers.bodies, pairs);
  answers.bring_to_contact(seed + 2, tangent);
  ASSERT_NO_FATAL_FAILURE(answers.expect_in_order(tangent, seed + 1));
}

TEST(Answer, OfSyntheticShapes) {
  expect_answers_in_order(2402, synthetic_bodies(2401, 40), test::samples(8'000));
}

TEST(Answer, OfDefaultCharacters) {
  expect_answers_in_order(2411, test::posed_bodies(test::default_characters(), 8), 3'000);
}

TEST(Answer, OfRealCharacters) {
  const auto data = test::test_data();
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set: no real characters to test with";
  expect_answers_in_order(2421, test::posed_bodies(test::real_characters(*data), 6), 3'000);
}

bool operator==(const TestCounts& a, const TestCounts& b) {
  return a.nodes == b.nodes && a.leaves == b.leaves && a.ancestors == b.ancestors;
}

/// A limit that no leaf lies below changes nothing, not even what is tested.
TEST(Counts, OfLimitedDepthsAreThoseOfTheSameDescent) {
  const Answers answers(synthetic_bodies(2431, 40));
  const PairScene scene = test::placements(2432, answers.bodies, 3'000);
  const Agents agents = scene.crowd.agents();
  for (const Pair pair : scene.pairs) {
    TestCounts root, limited, unlimited, descent;
    const bool root_hit = answers.fast->query(agents, pair, 0, root);
    EXPECT_TRUE((root == TestCounts{1, 0, root_hit ? 1u : 0u}));
    const bool hit = answers.fast->query(agents, pair, all_depths, unlimited);
    EXPECT_EQ(answers.fast->query(agents, pair, 1000, limited), hit);
    EXPECT_TRUE(limited == unlimited);
    const bool met = answers.descent->query(agents, pair, all_depths, descent);
    EXPECT_EQ(descent.ancestors, 0u);
    EXPECT_EQ(unlimited.ancestors > 0, met);
    if (met) {
      EXPECT_GE(unlimited.nodes, descent.nodes);
    } else {
      EXPECT_EQ(unlimited.nodes, descent.nodes);
    }
  }
}

/// A root with two leaves.
Body two_leaves(Disc root, Disc first, Disc second) {
  Body body;
  body.shape.hierarchy.nodes = {{root, 2}, {first, 0}, {second, 0}};
  body.shape.hierarchy.max_extent = 2;
  return body;
}

/// Both unturned, the second agent at (x, 0).
test::Crowd beside(double x) {
  test::Crowd crowd;
  crowd.add({0, 0, 0, 0, 0});
  crowd.add({1, x, 0, 0, 0});
  return crowd;
}

void expect_answers(const Answers& answers, const Agents& agents, std::uint32_t depth, bool hit, bool met) {
  const baselines::Reference slow(answers.shapes, {{depth}});
  EXPECT_EQ(slow.boundary(agents, {0, 1}, Method::brute_force), hit);
  EXPECT_EQ(slow.boundary(agents, {0, 1}, Method::depth_first), hit);
  EXPECT_EQ(answers.fast->query(agents, {0, 1}, depth), hit);
  EXPECT_EQ(answers.descent->query(agents, {0, 1}, depth), met);
  EXPECT_NE(baselines::contacts({answers.shapes, {{depth}}}, agents, {1, 0}).empty(), hit);
}

TEST(Examples, WhatSticksOutOfADiscAboveDoesNotCount) {
  const Disc root{0, 0, 1}, right{0.9f, 0, 0.5f}, left{-0.9f, 0, 0.5f};
  const Answers answers(std::vector<Body>(2, two_leaves(root, right, left)));
  const test::Crowd apart = beside(2.2), together = beside(1.9);
  const baselines::CutLists leaves(answers.shapes, {});
  EXPECT_TRUE(baselines::discs_overlap(baselines::float_placement(apart.agents(), {0, 1}),
                                       leaves.of(apart.agents(), 0)[0], leaves.of(apart.agents(), 1)[1]));
  for (const std::uint32_t depth : {0u, 1u, all_depths}) {
    expect_answers(answers, apart.agents(), depth, false, false);
    expect_answers(answers, together.agents(), depth, true, true);
  }
}

/// The larger root descends first, so that it never meets the leaf of the other one that it has no point in common with.
TEST(Examples, TheDescentMeetsOnlySomeAncestors) {
  const Answers answers({two_leaves({0, 0, 1}, {0.9f, 0, 0.5f}, {-0.5f, 0, 0.4f}),
                         two_leaves({0, 0, 0.95f}, {-0.3f, 0, 0.3f}, {0.4f, 0, 0.4f})});
  const test::Crowd crowd = beside(1.9);
  expect_answers(answers, crowd.agents(), 0, true, true);
  expect_answers(answers, crowd.agents(), 1, false, true);
  expect_answers(answers, crowd.agents(), all_depths, false, true);
}

/// Discs of the cuts overlap where the two do not collide: a way, however short, begins with their contact.
TEST(Examples, TimesOfImpactStartWithDiscsThatOverlap) {
  const Disc root{0, 0, 1}, right{0.9f, 0, 0.5f}, left{-0.9f, 0, 0.5f};
  const Answers answers(std::vector<Body>(2, two_leaves(root, right, left)));
  const test::Crowd apart = beside(2.2), together = beside(1.9);
  baselines::TimeOfImpactReference times(answers.shapes, {});
  for (const Method method : {Method::brute_force, Method::depth_first}) {
    EXPECT_EQ(times.query(apart.agents(), {0, 1}, 0, 0, method), std::numeric_limits<float>::infinity());
    EXPECT_EQ(times.query(apart.agents(), {0, 1}, 1, 0, method), 0);
    EXPECT_EQ(times.query(apart.agents(), {0, 1}, -1, 0, method), 0);
    EXPECT_EQ(times.query(together.agents(), {0, 1}, 0, 0, method), 0);
  }
}

/// Higher than what a query keeps on its caller's stack.
TEST(Examples, TreesMayBeHigh) {
  test::Random random(2441);
  Body comb;
  auto& nodes = comb.shape.hierarchy.nodes;
  comb.shape.hierarchy.max_extent = 2;
  for (std::uint32_t i = 0; i < 300; ++i) {
    const auto along = static_cast<float>(0.01 * i - 1.5);
    nodes.push_back({{0, 0, 2}, static_cast<std::uint32_t>(nodes.size() + 2)});
    nodes.push_back({{along, static_cast<float>(random.uniform(-0.02, 0.02)), 0.01f}, 0});
  }
  nodes.push_back({{1.5f, 0, 0.01f}, 0});
  const Answers answers({comb});
  const baselines::Reference slow(answers.shapes, {});
  std::size_t hits = 0;
  for (int i = 0; i < 200; ++i) {
    test::Crowd crowd;
    crowd.add({0, 0, 0, 0, 0});
    crowd.add({0, random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3), 0});
    const bool hit = slow.boundary(crowd.agents(), {0, 1}, Method::brute_force);
    EXPECT_EQ(slow.boundary(crowd.agents(), {0, 1}, Method::depth_first), hit);
    EXPECT_EQ(answers.fast->query(crowd.agents(), {0, 1}, all_depths), hit);
    hits += hit;
  }
  EXPECT_GT(hits, 20u);
  EXPECT_LT(hits, 180u);
}

}  // namespace
}  // namespace bch
