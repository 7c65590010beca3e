// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/clearances.hpp"
#include "tests/support/differential.hpp"
#include "tests/support/scenes.hpp"

// What clearance() says of input at the edges of what is allowed, and beyond.

namespace bch {
namespace {

using test::answers;
using test::Answers;
using test::four_levels;
using test::PairScene;
using test::Random;

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Clearance, OfSingleDiscs) {
  const std::vector<Shape> shapes = {{{}, fixed_cylinder(0.25f)}, {{}, fixed_cylinder(0.5f)}};
  for (const ShapeSetPlan& levels : {ShapeSetPlan{{0}}, ShapeSetPlan{}}) {
    const ShapeSet set(shapes, levels);
    test::Crowd crowd;
    crowd.add({0, 1, 1, 0.7, 0});
    crowd.add({1, 4, 5, 2, 0});
    crowd.add({1, 1, 1, 3, 0});
    const std::vector<Pair> pairs = {{0, 1}, {1, 0}, {0, 2}, {2, 0}, {0, 0}};
    const auto of = answers(set, crowd.agents(), pairs, infinity);
    EXPECT_NEAR(of.distance[0], 4.25, 1e-5);
    EXPECT_NEAR(of.direction[0].x, 0.6, 1e-6);
    EXPECT_NEAR(of.direction[0].y, 0.8, 1e-6);
    EXPECT_EQ(of.direction[1], (Vec2{-of.direction[0].x, -of.direction[0].y}));
    EXPECT_NEAR(of.distance[2], -0.75, 1e-5);
    EXPECT_EQ(of.direction[2], (Vec2{1, 0}));  // coincident centres
    EXPECT_EQ(of.direction[3], (Vec2{-1, 0}));
    EXPECT_NEAR(of.distance[4], -0.5, 1e-5);  // an agent and itself
    EXPECT_EQ(of.direction[4], (Vec2{1, 0}));
    EXPECT_EQ(of.discs[4], (DiscPair{0, 0}));
    const auto limited = answers(set, crowd.agents(), pairs, 4);
    EXPECT_EQ(limited.distance[0], std::numeric_limits<float>::infinity());
    EXPECT_EQ(limited.direction[0], (Vec2{0, 0}));
    EXPECT_EQ(limited.discs[0], no_discs);
    std::vector<float> distance(pairs.size());
    std::vector<NearestPoints> points(pairs.size(), {{1, 1}, {1, 1}});
    clearance(set, crowd.agents(), pairs, {.distance = distance, .points = points}, {.max_distance = 4.5});
    EXPECT_NEAR(points[0].first.x, 0.15, 1e-5);
    EXPECT_NEAR(points[0].first.y, 0.2, 1e-5);
    EXPECT_NEAR(points[0].second.x, -0.3, 1e-5);
    EXPECT_NEAR(points[0].second.y, -0.4, 1e-5);
    EXPECT_EQ(points[1], (NearestPoints{points[0].second, points[0].first}));
    EXPECT_EQ(points[2], NearestPoints{});  // they overlap
    const auto touching = answers(set, crowd.agents(), pairs, 0);
    EXPECT_EQ(touching.distance[2], of.distance[2]);
    EXPECT_EQ(touching.distance[0], std::numeric_limits<float>::infinity());
  }
}

/// What overlaps has a distance of 0 and nothing else; what does not, the same answer for either.
TEST(Clearance, OverlapIsZeroByDefault) {
  const ShapeSet set(test::synthetic_shapes(6, 8), four_levels);
  Random random(8);
  const PairScene scene = random_scene(random, set, 3'000);
  Answers all(scene.pairs.size());
  clearance(set, scene.crowd.agents(), scene.pairs, all.spans());
  const Answers deepest = answers(set, scene.crowd.agents(), scene.pairs, infinity);
  std::size_t overlapping = 0;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    if (deepest.distance[i] > 0) {
      ASSERT_TRUE(all.same(i, deepest, i)) << i;
      continue;
    }
    ++overlapping;
    EXPECT_EQ(all.distance[i], 0) << i;
    EXPECT_EQ(all.direction[i], (Vec2{0, 0})) << i;
    EXPECT_EQ(all.discs[i], no_discs) << i;
  }
  EXPECT_GT(overlapping, 500u);
  EXPECT_LT(overlapping, 2'500u);
}

TEST(Clearance, AnswersThatAreNotAskedForChangeNoOthers) {
  const ShapeSet set(test::synthetic_shapes(6, 8), four_levels);
  Random random(7);
  const PairScene scene = random_scene(random, set, 3'000);
  const Answers all = answers(set, scene.crowd.agents(), scene.pairs, 0.5);
  std::vector<float> distance(scene.pairs.size());
  clearance(set, scene.crowd.agents(), scene.pairs, {distance, {}, {}},
            {.max_distance = 0.5, .overlap = Overlap::deepest});
  EXPECT_EQ(distance, all.distance);
}

TEST(Clearance, RejectsBadInputBeforeAnythingIsWritten) {
  const ShapeSet set(test::synthetic_shapes(1, 2));
  test::Crowd crowd;
  crowd.add({0, 0, 0, 0, 0});
  crowd.add({1, 1, 0, 0, 0});
  std::vector<Pair> pairs = {{0, 1}};
  Answers all(1);
  const auto expect_rejected = [&](const std::string& message, const ClearanceAnswers& spans,
                                   double max_distance = 1, Overlap overlap = Overlap::zero) {
    std::fill(all.distance.begin(), all.distance.end(), 42.0f);
    try {
      clearance(set, crowd.agents(), pairs, spans, {.max_distance = max_distance, .overlap = overlap});
      FAIL() << "accepted; expected: " << message;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
    EXPECT_EQ(all.distance[0], 42);
  };
  expect_rejected("max_distance of nan", all.spans(), std::nan(""));
  expect_rejected("max_distance of -0.5", all.spans(), -0.5);
  expect_rejected("no overlap is 2", all.spans(), 1, Overlap{2});
  crowd.x[1] = std::nan("");
  expect_rejected("pair 0: agent 1: position (nan, 0)", all.spans());
  crowd.x[1] = 1;
  pairs = {{0, 2}};
  expect_rejected("pair 0: agent 2 of 2", all.spans());
  pairs = {{0, 1}, {1, 0}};
  expect_rejected("2 pairs but 1 distances", {all.distance});
  Answers two(2);
  expect_rejected("2 pairs but 1 directions", {two.distance, all.direction});
  expect_rejected("2 pairs but 1 discs", {two.distance, two.direction, all.discs});
  std::vector<NearestPoints> one(1);
  expect_rejected("2 pairs but 1 points", {.distance = two.distance, .points = one});
  expect_rejected("2 pairs but 0 distances", {{}, two.direction, two.discs});
}

}  // namespace
}  // namespace bch
