// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/reference.hpp"
#include "kernel/runtime/kernels.hpp"
#include "layout/base/heading.hpp"
#include "layout/base/processor.hpp"
#include "layout/format/shape_set_view.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"
#include "tests/support/differential.hpp"
#include "tests/support/test.hpp"

namespace bch {
namespace {

using baselines::Method;
using baselines::Reference;
using test::PairScene;
using test::Random;

const ShapeSetPlan plan{{0, 3, 6, all_depths}, true};

std::vector<std::uint8_t> answers(const ShapeSet& set, const Agents& agents, std::span<const Pair> pairs,
                                  const Implementation& implementation) {
  std::vector<std::uint8_t> hits(pairs.size(), 77);
  collide(set, agents, pairs, hits, {&implementation});
  return hits;
}

/// Every implementation against brute force; says which pair differs and where it stands.
void expect_equal_to_brute_force(const ShapeSet& set, const Reference& reference, const PairScene& scene,
                                 const std::string& what) {
  const Agents agents = scene.crowd.agents();
  std::vector<std::uint8_t> expected;
  for (const Pair& pair : scene.pairs) expected.push_back(reference.solid(agents, pair, Method::brute_force));
  const auto hits = std::count(expected.begin(), expected.end(), 1);
  EXPECT_GT(hits, 0) << what;
  EXPECT_LT(hits, std::ssize(expected)) << what;
  for (const Implementation& implementation : test::supported()) {
    const auto hits_of = answers(set, agents, scene.pairs, implementation);
    for (std::size_t i = 0; i < expected.size(); ++i)
      ASSERT_EQ(hits_of[i], expected[i])
          << what << ", " << implementation.name << ", pair " << i << ": shapes " << agents.shape[2 * i]
          << " and " << agents.shape[2 * i + 1];
  }
}

class Differential : public test::Differential {
 protected:
  Differential() : test::Differential(20141, plan) {}
};

/// Beside those of queries_test, to a million: at random, near tangent, and of either kind far from the origin.
TEST_F(Differential, ManyPairs) {
  for (std::uint32_t i = 0; i < test::samples(28); ++i) {
    PairScene scene = i % 2 == 0 ? random_scene(random, set, 25'000) : tangent_scene(25'000);
    if (i % 4 >= 2) test::move_away(scene, 1e7, -8e8);
    expect_equal_to_brute_force(set, discs, scene, "scene " + std::to_string(i));
  }
}

/// A wedge points to where its sector is that a direction of zero length has. Inside it lies a smaller one, whose far end
/// sticks out farther behind the common centre than the larger one goes on before it.
TEST(Collide, AContourInsideAnotherOfTheSameCentreIsFound) {
  const Outline wedge = test::polygon({{-1, 0}, {0.25f, -0.5f}, {0.25f, 0.5f}});
  Outline smaller = wedge;
  for (Vec2& p : smaller.points) p = {0.75f * p.x, 0.75f * p.y};
  const std::vector<Shape> shapes = {test::contour_shape(wedge), test::contour_shape(smaller)};
  const ShapeSet set(shapes), discs(shapes, {.outlines = false});
  const detail::Profile* const profiles = set.view().profiles;
  ASSERT_EQ(profiles[0].y, 0);
  ASSERT_EQ(profiles[1].y, 0);
  test::PairScene scene;
  scene.crowd.add({0, 0, 0, 0, 0});
  scene.crowd.add({1, static_cast<double>(profiles[0].x) - static_cast<double>(profiles[1].x), 0, 0, 0});
  scene.pairs = {{0, 1}};
  for (const Implementation& implementation : test::supported()) {
    EXPECT_EQ(answers(set, scene.crowd.agents(), scene.pairs, implementation)[0], 1) << implementation.name;
    EXPECT_EQ(answers(discs, scene.crowd.agents(), scene.pairs, implementation)[0], 0) << implementation.name;
  }
}

TEST(Collide, TouchingCountsAndAnAgentMeetsItself) {
  const std::vector<Shape> shapes = {{{}, detail::fixed_cylinder(0.25f)}};
  const ShapeSet set(shapes);
  const float radius = set.view().roots[0].radius;
  test::Crowd crowd;
  crowd.add({0, 0, 0, 0, 0});
  crowd.add({0, 2 * static_cast<double>(radius), 0, 0, 0});
  crowd.add({0, -2 * static_cast<double>(std::nextafter(radius, 1.0f)), 0, 0, 0});
  const std::vector<Pair> pairs = {{0, 1}, {0, 2}, {1, 2}, {1, 1}};
  std::vector<std::uint8_t> hits(4);
  collide(set, crowd.agents(), pairs, hits);
  EXPECT_EQ(hits, (std::vector<std::uint8_t>{1, 0, 0, 1}));
}

TEST(Implementations, AreNamedAndEndWithOnesThatRunEverywhere) {
  const auto all = implementations();
  const std::vector<std::string> names{BCH_ON_X86("avx512", "avx2", "sse2", ) BCH_ON_NEON("neon", ) "scalar"};
  ASSERT_EQ(all.size(), names.size());
  std::string known;
  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(all[i].name, names[i]);
    known += (i == 0 ? "" : ", ") + names[i];
  }
  EXPECT_TRUE(all.back().supported());
  EXPECT_EQ(implementation("scalar").kernels->width, 1u);
  EXPECT_EQ(test::complaint([] { implementation("altivec"); }),
            "no implementation 'altivec' (known: " + known + ")");
}

}  // namespace
}  // namespace bch
