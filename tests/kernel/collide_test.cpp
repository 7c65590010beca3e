// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/collide.hpp>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <cmath>
#include <string>
#include <vector>

#include "baselines/oracle.hpp"
#include "baselines/reference.hpp"
#include "kernel/runtime/kernels.hpp"
#include "layout/base/processor.hpp"
#include "layout/format/shape_set_view.hpp"
#include "tests/support/differential.hpp"

namespace bch {
namespace {

using baselines::Method;
using baselines::Reference;
using test::PairScene;
using test::Random;

const ShapeSetPlan plan{{0, 3, 6, all_depths}, true};

std::vector<std::uint8_t> answers(const ShapeSet& set, const Agents& agents, std::span<const Pair> pairs,
                                  Semantics semantics, const Implementation& implementation) {
  std::vector<std::uint8_t> hits(pairs.size(), 77);
  collide(set, agents, pairs, hits, {semantics, &implementation});
  return hits;
}

/// Every implementation and both semantics against brute force; says which pair differs and where it stands.
void expect_equal_to_brute_force(const ShapeSet& set, const Reference& reference, const PairScene& scene,
                                 const std::string& what) {
  const Agents agents = scene.crowd.agents();
  for (const Semantics semantics : {Semantics::boundary, Semantics::solid}) {
    std::vector<std::uint8_t> expected;
    for (const Pair& pair : scene.pairs)
      expected.push_back(semantics == Semantics::boundary
                             ? reference.boundary(agents, pair, Method::brute_force)
                             : reference.solid(agents, pair, Method::brute_force));
    const auto hits = std::count(expected.begin(), expected.end(), 1);
    EXPECT_GT(hits, 0) << what;
    EXPECT_LT(hits, std::ssize(expected)) << what;
    for (const auto& implementation : implementations()) {
      if (!implementation.supported()) continue;
      const auto hits_of = answers(set, agents, scene.pairs, semantics, implementation);
      for (std::size_t i = 0; i < expected.size(); ++i)
        ASSERT_EQ(hits_of[i], expected[i])
            << what << ", " << implementation.name << ", pair " << i << ": shapes " << agents.shape[2 * i]
            << " and " << agents.shape[2 * i + 1];
    }
  }
}

class Differential : public test::Differential {
 protected:
  Differential() : test::Differential(20141, plan) {}

  const Reference& reference = discs;
};

TEST_F(Differential, RandomPairs) {
  for (int i = 0; i < 16; ++i) {
    PairScene scene = random_scene(random, set, 25'000);
    expect_equal_to_brute_force(set, reference, scene, "random " + std::to_string(i));
  }
}

TEST_F(Differential, NearTangentPairs) {
  for (std::uint32_t i = 0; i < test::samples(16); ++i) {
    PairScene scene = tangent_scene(25'000);
    expect_equal_to_brute_force(set, reference, scene, "near tangent " + std::to_string(i));
  }
}

TEST_F(Differential, WithoutShortcuts) {
  const ShapeSet plain(shapes, {.depths = plan.depths, .outlines = true, .culling = false});
  expect_equal_to_brute_force(plain, reference, random_scene(random, plain, 25'000), "random");
  expect_equal_to_brute_force(plain, reference, tangent_scene(25'000), "near tangent");
}

TEST_F(Differential, ManyShapes) {
  const std::vector<Shape> many = test::repeated(shapes);
  const ShapeSet large(many, plan);
  expect_equal_to_brute_force(large, Reference(many, plan), random_scene(random, large, 5'000), "many");
}

/// Rounding grows with the larger of two shapes, and pruning has to allow for that in the discs of the smaller one.
TEST(Sizes, AnAntMeetsAnElephant) {
  Random random(20142);
  std::vector<Shape> shapes;
  for (int i = 0; i < 12; ++i) {
    const double size = i % 2 == 0 ? 0.02 : 20;
    Shape& shape = shapes.emplace_back();
    shape.outline = test::star(random, 60, 0.6 * size, size);
    shape.hierarchy = contour_hierarchy(shape.outline, static_cast<float>(0.02 * size));
  }
  const ShapeSetPlan levels{.depths = {0, 3, all_depths}, .outlines = true};
  const ShapeSet set(shapes, levels);
  const Reference reference(shapes, levels);
  for (int i = 0; i < 2; ++i) {
    PairScene scene = random_scene(random, set, test::samples(2'000));
    make_tangent(random, scene, [&](const Agents& agents, Pair pair) {
      return reference.boundary(agents, pair, Method::brute_force);
    });
    expect_equal_to_brute_force(set, reference, scene, "sizes " + std::to_string(i));
  }
}

TEST_F(Differential, FarFromTheOriginTheAnswerIsTheSame) {
  for (int i = 0; i < 8; ++i) {
    PairScene scene = random_scene(random, set, 25'000);
    const auto at_origin =
        answers(set, scene.crowd.agents(), scene.pairs, Semantics::solid, best_implementation());
    test::move_away(scene, 1e7, -8e8);
    expect_equal_to_brute_force(set, reference, scene, "far " + std::to_string(i));
    EXPECT_EQ(answers(set, scene.crowd.agents(), scene.pairs, Semantics::solid, best_implementation()),
              at_origin);
  }
}

TEST_F(Differential, TheDepthFirstTraversalEqualsBruteForce) {
  PairScene scene = tangent_scene(50'000);
  for (const Pair& pair : scene.pairs)
    ASSERT_EQ(reference.boundary(scene.crowd.agents(), pair, Method::depth_first),
              reference.boundary(scene.crowd.agents(), pair, Method::brute_force));
}

TEST_F(Differential, BatchesOfEverySizeAndOffset) {
  PairScene scene = random_scene(random, set, 600);
  const Agents agents = scene.crowd.agents();
  for (const auto& implementation : implementations()) {
    if (!implementation.supported()) continue;
    const auto whole = answers(set, agents, scene.pairs, Semantics::solid, implementation);
    const std::size_t sizes[] = {0,
                                 1,
                                 implementation.kernels->width - 1,
                                 implementation.kernels->width,
                                 implementation.kernels->width + 1,
                                 3 * implementation.kernels->width,
                                 255,
                                 256,
                                 257,
                                 513};
    for (const std::size_t size : sizes)
      for (const std::size_t offset : {0, 1, 3, 13, 62}) {
        std::vector<std::uint8_t> hits(size + 2, 99);
        collide(set, agents, std::span(scene.pairs).subspan(offset, size), std::span(hits).subspan(1, size),
                {Semantics::solid, &implementation});
        EXPECT_EQ(hits.front(), 99);
        EXPECT_EQ(hits.back(), 99);
        EXPECT_TRUE(
            std::equal(hits.begin() + 1, hits.end() - 1, whole.begin() + static_cast<std::ptrdiff_t>(offset)))
            << implementation.name << ", " << size << " pairs from " << offset;
      }
  }
}

TEST_F(Differential, AnyNumberOfThreads) {
  const PairScene scene = random_scene(random, set, 50'000);
  std::vector<std::uint8_t> expected;
  for (int threads = 1; threads <= 8; ++threads) {
    const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
    tbb::task_arena arena(threads);
    std::vector<std::uint8_t> hits(scene.pairs.size());
    arena.execute([&] { collide(set, scene.crowd.agents(), scene.pairs, hits, {Semantics::solid}); });
    if (expected.empty()) expected = hits;
    EXPECT_EQ(hits, expected) << threads << " threads";
  }
}

TEST_F(Differential, TheOrderWithinAPairDoesNotMatter) {
  PairScene scene = tangent_scene(50'000);
  const auto hits =
      answers(set, scene.crowd.agents(), scene.pairs, Semantics::boundary, best_implementation());
  for (Pair& pair : scene.pairs) std::swap(pair.first, pair.second);
  EXPECT_EQ(answers(set, scene.crowd.agents(), scene.pairs, Semantics::boundary, best_implementation()),
            hits);
}

/// Outlines that meet are found at every level, by every implementation.
TEST_F(Differential, NoOutlineCrossingIsMissed) {
  const auto crosses = [&](const Agents& agents, Pair pair) {
    return baselines::Oracle(shapes[agents.shape[pair.first]].outline,
                             shapes[agents.shape[pair.second]].outline,
                             baselines::exact_placement(agents, pair.first, pair.second))
        .cross();
  };
  PairScene scene = random_scene(random, set, 1'500);
  make_tangent(random, scene, crosses);
  const Agents agents = scene.crowd.agents();
  std::vector<std::uint8_t> meet;
  for (const Pair pair : scene.pairs) meet.push_back(crosses(agents, pair));
  EXPECT_GT(std::count(meet.begin(), meet.end(), 1), std::ssize(meet) / 3);
  for (const auto& implementation : implementations()) {
    if (!implementation.supported()) continue;
    const auto hits = answers(set, agents, scene.pairs, Semantics::boundary, implementation);
    for (std::size_t i = 0; i < hits.size(); ++i)
      EXPECT_TRUE(hits[i] == 1 || meet[i] == 0) << implementation.name << ", pair " << i;
  }
}

/// Supports and inscribed discs decide pairs early, and nothing else.
TEST_F(Differential, ShortcutsChangeNoAnswer) {
  const ShapeSet plain(shapes, {plan.depths, true, false});
  EXPECT_LT(plain.bytes(), set.bytes());
  PairScene scene = tangent_scene(100'000);
  for (const Semantics semantics : {Semantics::boundary, Semantics::solid})
    EXPECT_EQ(answers(plain, scene.crowd.agents(), scene.pairs, semantics, best_implementation()),
              answers(set, scene.crowd.agents(), scene.pairs, semantics, best_implementation()));
}

TEST(Solid, AShapeInsideAnotherIsFoundEverywhere) {
  Random random(5);
  const Outline big = test::star(random, 80, 0.35, 0.5);
  Outline small = big;
  for (Vec2& p : small.points) p = {0.25f * p.x, 0.25f * p.y};
  small.grid_step = 0.25f * big.grid_step;
  const std::vector<Shape> shapes = {test::contour_shape(big), test::contour_shape(small)};
  const ShapeSet set(shapes, {{all_depths}, true});
  test::PairScene scene;
  for (std::uint32_t i = 0; i < 4000; ++i) {
    const double r = random.uniform(0, 0.2),
                 angle = random.uniform(-3, 3);  // the small one never leaves the big one
    scene.crowd.add({0, 3, 4, random.uniform(-3, 3), 0});
    scene.crowd.add({1, 3 + r * std::cos(angle), 4 + r * std::sin(angle), random.uniform(-3, 3), 0});
    scene.pairs.push_back({2 * i, 2 * i + 1});
  }
  for (const auto& implementation : implementations()) {
    if (!implementation.supported()) continue;
    const auto solid = answers(set, scene.crowd.agents(), scene.pairs, Semantics::solid, implementation);
    EXPECT_EQ(std::count(solid.begin(), solid.end(), 1), 4000) << implementation.name;
    const auto boundary =
        answers(set, scene.crowd.agents(), scene.pairs, Semantics::boundary, implementation);
    EXPECT_LT(std::count(boundary.begin(), boundary.end(), 1), 400) << implementation.name;
  }
}

TEST(Levels, TheSingleCylinderNeedsNoBlocks) {
  const std::vector<Shape> shapes = test::synthetic_shapes(3, 8);
  const ShapeSet roots(shapes, {{0}, false});
  EXPECT_TRUE(roots.roots_only());
  EXPECT_LE(roots.bytes(), 8 * 16u);
  test::Random random(4);
  const PairScene scene = random_scene(random, roots, 5'000);
  const Reference reference(shapes, {{0}, false});
  for (const auto& implementation : implementations()) {
    if (!implementation.supported()) continue;
    const auto hits = answers(roots, scene.crowd.agents(), scene.pairs, Semantics::boundary, implementation);
    for (std::size_t i = 0; i < hits.size(); ++i)
      ASSERT_EQ(hits[i], reference.boundary(scene.crowd.agents(), scene.pairs[i], Method::brute_force));
  }
}

TEST(Collide, TouchingCountsAndAnAgentMeetsItself) {
  const std::vector<Shape> shapes = {{{}, fixed_cylinder(0.25f)}};
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
  try {
    implementation("altivec");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(error.what(), "no implementation 'altivec' (known: " + known + ")");
  }
}

}  // namespace
}  // namespace bch
