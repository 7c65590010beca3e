// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/penetrations.hpp"
#include "tests/support/slab_comparison.hpp"
#include "tests/support/test.hpp"

// Depths of bodies in slabs, and at different heights, against the definition: what the scalar references say of every pair of
// parts that may meet.

namespace bch {
namespace {

using test::MovingScene;

constexpr std::uint32_t directions = 16;

class SlabPenetrations : public test::SlabComparison {
 protected:
  std::size_t hits(const MovingScene& scene) const {
    std::vector<std::uint8_t> all(scene.pairs.size());
    collide(set, scene.crowd.agents(), scene.pairs, all);
    return static_cast<std::size_t>(std::count(all.begin(), all.end(), 1));
  }
};

INSTANTIATE_TEST_SUITE_P(Three, SlabPenetrations, testing::Values(test::three_slabs));
INSTANTIATE_TEST_SUITE_P(Eight, SlabPenetrations, testing::Values(test::eight_slabs));
INSTANTIATE_TEST_SUITE_P(Whole, SlabPenetrations, testing::Values(std::vector<float>{}));

TEST_P(SlabPenetrations, DepthsAreTheLargestOfParts) {
  for (const MovingScene& scene : scenes(test::samples(3'000))) {
    std::vector<test::PartReferences::Depth> expected;
    for (std::size_t i = 0; i < scene.pairs.size(); ++i)
      expected.push_back(reference.depth(scene.crowd.agents(), scene.pairs[i], scene.along[i]));
    const std::vector<Penetration> best = test::along(scene.along, set, scene);
    expect_of_all(
        scene,
        [&](const Implementation& implementation) {
          return test::along(scene.along, set, scene, implementation);
        },
        [&](const std::vector<Penetration>& found, std::size_t i) {
          const double x = scene.along[i].x, y = scene.along[i].y, length = std::sqrt(x * x + y * y);
          const double depth = found[i].depth, least = expected[i].depth;
          return found[i] == best[i] && found[i].x == x / length && found[i].y == y / length &&
                 depth >= least && depth <= least * (1 + 0x1p-22) + 1.01 * expected[i].slack;
        });
  }
}

TEST_P(SlabPenetrations, TheBestDepthIsTheLeastOfDirections) {
  std::vector<Vec2> spread;
  for (std::uint32_t k = 0; k < directions; ++k) {
    const double angle = 2 * std::numbers::pi * k / directions;
    spread.push_back({static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))});
  }
  // Directions are rounded to float here.
  constexpr double rounding = 4e-6;
  for (const MovingScene& scene : scenes(test::samples(1'000))) {
    const std::vector<Penetration> best = test::best_of(directions, set, scene);
    expect_of_all(
        scene,
        [&](const Implementation& implementation) {
          return test::best_of(directions, set, scene, implementation);
        },
        [&](const std::vector<Penetration>& found, std::size_t i) { return found[i] == best[i]; });
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
      double least = HUGE_VAL, told = HUGE_VAL;
      for (const Vec2 along : spread) {
        const double depth = reference.depth(scene.crowd.agents(), scene.pairs[i], along).depth;
        least = std::min(least, depth);
        if (std::abs(static_cast<double>(along.x) - best[i].x) < 1e-6 &&
            std::abs(static_cast<double>(along.y) - best[i].y) < 1e-6)
          told = depth;
      }
      ASSERT_NEAR(best[i].depth, least, rounding) << i;
      ASSERT_NEAR(best[i].depth, told, rounding) << i;
    }
  }
}

TEST_P(SlabPenetrations, NothingOverlapsAfterTheDepth) {
  for (const bool raised : {false, true})
    for (const bool tangent : {false, true}) {
      const MovingScene before =
          tangent ? tangent_scene(test::samples(3'000), raised) : scene_of(10'000, raised);
      EXPECT_GT(hits(before), before.pairs.size() / 20);
      for (const auto& by : {test::best_of(directions, set, before), test::along(before.along, set, before)})
        for (const double further : {0.0, 1e-3, 0.1}) {
          MovingScene after = before;
          for (std::size_t i = 0; i < by.size(); ++i) {
            const double depth = static_cast<double>(by[i].depth) + further;
            after.crowd.x[after.pairs[i].first] += depth * by[i].x;
            after.crowd.y[after.pairs[i].first] += depth * by[i].y;
          }
          EXPECT_EQ(hits(after), 0u);
        }
    }
}

}  // namespace
}  // namespace bch
