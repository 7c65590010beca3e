// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>

#include <bch/default_characters.hpp>

#include "baselines/oracle.hpp"
#include "tests/support/baseline_scene.hpp"

// What theory says of limited depth and of coarser hierarchies: exact hits stay hits at every depth, and a
// false positive comes from volumes no farther apart than their own sizes.

namespace bch {
namespace {

using baselines::Body;
using baselines::Structure;
using test::PairScene;

class Depths : public testing::Test {
 protected:
  std::array<Character, 2> people{default_male(), default_female()};
  std::vector<Body> bodies = test::posed_bodies({people.begin(), people.end()}, 5);

  std::vector<std::uint8_t> hits(const Structure& structure, const PairScene& scene,
                                 std::uint32_t depth = all_depths) {
    std::vector<std::uint8_t> result(scene.pairs.size());
    structure.query(scene.crowd.agents(), scene.pairs, result, depth);
    return result;
  }

  /// Distance between the outlines of a pair, metres.
  double gap(const PairScene& scene, std::size_t pair) {
    const Agents agents = scene.crowd.agents();
    const auto [a, b] = std::minmax(scene.pairs[pair].first, scene.pairs[pair].second);
    const auto& outline_a = bodies[agents.shape[a]].shape.outline;
    const auto& outline_b = bodies[agents.shape[b]].shape.outline;
    return static_cast<double>(
        baselines::Oracle(outline_a, outline_b, baselines::exact_placement(agents, a, b)).distance());
  }
};

/// The largest radius in a hierarchy's cut.
double largest_radius(const Hierarchy& hierarchy, std::uint32_t depth) {
  double radius = 0;
  for (const std::uint32_t node : cut(hierarchy, depth))
    radius = std::max(radius, static_cast<double>(hierarchy.nodes[node].disc.radius));
  return radius;
}

TEST_F(Depths, ExactHitsStayHitsAtEveryDepth) {
  const PairScene scene = test::placements(31, bodies, 20'000);
  std::printf("seed 31, %zu placements\n", scene.pairs.size());
  for (const baselines::Kind& kind : baselines::kinds()) {
    const auto structure = kind.build(bodies, {});
    const auto deepest = hits(*structure, scene);
    if (!kind.has_depth) {
      EXPECT_EQ(hits(*structure, scene, 2), deepest) << kind.name;
      continue;
    }
    EXPECT_EQ(hits(*structure, scene, 100), deepest) << kind.name;
    if (kind.name == "paper_descent") continue;  // what it hits depends on its way down
    // Boxes stick out of those above, so single answers may come back; numbers shrink.
    const bool only_shrinks = kind.name == "reference" || kind.name == "bch_projected";
    std::vector<std::uint8_t> before(deepest.size(), 1);
    for (const std::uint32_t depth : {0u, 1u, 2u, 3u, 4u, 6u, 8u, 12u}) {
      const auto at_depth = hits(*structure, scene, depth);
      for (std::size_t i = 0; i < deepest.size(); ++i)
        ASSERT_TRUE(at_depth[i] >= deepest[i] && (!only_shrinks || at_depth[i] <= before[i]))
            << kind.name << " to depth " << depth << ", " << test::replay_line(scene, i);
      EXPECT_LE(std::count(at_depth.begin(), at_depth.end(), 1),
                std::count(before.begin(), before.end(), 1) + (test::replaying() ? 1 : 20))
          << kind.name << " to depth " << depth;
      before = at_depth;
    }
  }
}

/// Two overlapping discs hold outlines within twice the sum of their radii.
TEST_F(Depths, FalsePositivesAreWithinTheDiscsOfTheirDepth) {
  const PairScene scene = test::placements(32, bodies, 6'000);
  std::printf("seed 32, %zu placements\n", scene.pairs.size());
  const auto reference = baselines::kind("reference").build(bodies, {});
  const auto crossing = hits(*baselines::kind("obb_contour").build(bodies, {}), scene);
  for (const std::uint32_t depth : {0u, 2u, 4u, 6u, all_depths}) {
    const auto at_depth = hits(*reference, scene, depth);
    double widest = 0;
    for (std::size_t i = 0; i < at_depth.size(); ++i) {
      ASSERT_GE(at_depth[i], crossing[i]) << "depth " << depth << ", " << test::replay_line(scene, i);
      if (at_depth[i] == crossing[i]) continue;
      const double distance = gap(scene, i);
      double sum = 0;
      for (const std::uint32_t agent : {scene.pairs[i].first, scene.pairs[i].second})
        sum += largest_radius(bodies[scene.crowd.shape[agent]].shape.hierarchy, depth);
      ASSERT_LE(distance, 2 * sum + 1e-6) << "depth " << depth << ", " << test::replay_line(scene, i);
      widest = std::max(widest, distance);
    }
    std::printf("depth %s: %td hits, widest gap %.4f m\n",
                depth == all_depths ? "all" : std::to_string(depth).c_str(),
                std::count(at_depth.begin(), at_depth.end(), 1), widest);
  }
}

TEST_F(Depths, ASmallerThresholdHasFalsePositivesWithinItsOwnDiscs) {
  const PairScene scene = test::placements(33, bodies, 6'000);
  std::printf("seed 33, %zu placements\n", scene.pairs.size());
  const auto crossing = hits(*baselines::kind("obb_contour_2d").build(bodies, {}), scene);
  for (const float threshold : {0.08f, 0.04f, 0.02f, 0.01f, 0.005f, 0.0025f}) {
    std::vector<Body> finer = bodies;
    for (Body& body : finer) body.shape.hierarchy = contour_hierarchy(body.shape.outline, threshold);
    const auto at_threshold = hits(*baselines::kind("reference").build(finer, {}), scene);
    for (std::size_t i = 0; i < at_threshold.size(); ++i) {
      ASSERT_GE(at_threshold[i], crossing[i])
          << "threshold " << threshold << ", " << test::replay_line(scene, i);
      if (at_threshold[i] == crossing[i]) continue;
      ASSERT_LE(gap(scene, i), 4 * static_cast<double>(threshold) + 1e-6)
          << "threshold " << threshold << ", " << test::replay_line(scene, i);
    }
    std::printf("threshold %.4f m: %td hits, %td crossings\n", static_cast<double>(threshold),
                std::count(at_threshold.begin(), at_threshold.end(), 1),
                std::count(crossing.begin(), crossing.end(), 1));
  }
}

TEST_F(Depths, DiscsAloneCoverTheTrianglesTheyStandFor) {
  const PairScene scene = test::placements(34, bodies, 20'000);
  std::printf("seed 34, %zu placements\n", scene.pairs.size());
  const baselines::Kind& kind = baselines::kind("bch_projected");
  const auto exact = kind.build(bodies, {}), discs = kind.build(bodies, {.projected_triangles = false});
  EXPECT_LT(discs->bytes(0), exact->bytes(0));
  const auto with = hits(*exact, scene), without = hits(*discs, scene);
  for (std::size_t i = 0; i < with.size(); ++i) ASSERT_GE(without[i], with[i]) << test::replay_line(scene, i);
  if (!test::replaying()) {
    EXPECT_GT(std::count(without.begin(), without.end(), 1), std::count(with.begin(), with.end(), 1));
  }
}

}  // namespace
}  // namespace bch
