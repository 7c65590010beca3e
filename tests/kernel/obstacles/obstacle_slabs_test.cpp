// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <bch/collide.hpp>
#include <bch/obstacles.hpp>

#include "tests/support/obstacle_answers.hpp"
#include "tests/support/obstacle_scenes.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/slab_scenes.hpp"

// Bodies in slabs among obstacles.

namespace bch {
namespace {

using Answers = test::ObstacleAnswers;
using Obstacles = test::ObstacleTest;
using test::all_answers;
using test::Crowd;
using test::distances_for;
using test::ObstacleScene;

/// A body in slabs collides where one of its parts does, as a shape of its own.
TEST_F(Obstacles, OfBodiesInSlabs) {
  const ShapeSetPlan plan = test::levels_of(test::three_slabs);
  const std::vector<Shape> bodies = test::bodies(random, plan);
  const ShapeSet whole(bodies, plan);
  std::vector<Shape> parts;
  std::vector<std::vector<std::uint32_t>> parts_of;
  for (const Shape& body : bodies) {
    auto& numbers = parts_of.emplace_back();
    const auto add = [&](const Shape& part) {
      if (part.hierarchy.nodes.empty()) return;
      numbers.push_back(static_cast<std::uint32_t>(parts.size()));
      parts.push_back({part.outline, part.hierarchy});
    };
    if (body.slabs.empty()) add(body);
    for (const Shape& slab : body.slabs) add(slab);
  }
  const ShapeSet apart(parts, {.depths = plan.depths});
  QueryOptions solid{.semantics = Semantics::solid};
  std::size_t hits = 0;
  for (std::uint32_t k = 0; k < test::samples(16); ++k) {
    const ObstacleScene scene = test::obstacle_scene(random, 16, 3);
    const ObstacleSet obstacles = scene.set();
    const Crowd crowd = test::crowd_about(random, whole, 500, 3);
    solid.distance_leaves = k % 2 == 0 ? Leaves::discs : Leaves::segments;
    const std::vector<double> distances = distances_for(random, 500);
    std::vector<double> way(500);
    for (double& length : way) length = random.uniform(-1, 1);
    const Answers of_whole = all_answers(whole, crowd.agents(), obstacles, solid, distances, {way, way});
    for (std::uint32_t i = 0; i < 500; ++i) {
      Crowd pieces;
      for (const std::uint32_t part : parts_of[crowd.shape[i]])
        pieces.add({part, crowd.x[i], crowd.y[i], crowd.heading[i], crowd.level[i]});
      const std::vector<double> ways(pieces.x.size(), way[i]);
      const Answers of_parts =
          all_answers(apart, pieces.agents(), obstacles, solid, {&distances[i], 1}, {ways, ways});
      const auto any = [](const auto& values) { return *std::max_element(values.begin(), values.end()); };
      const auto least = [](const auto& values) { return *std::min_element(values.begin(), values.end()); };
      ASSERT_EQ(of_whole.hits[i], any(of_parts.hits));
      ASSERT_EQ(of_whole.near[i], any(of_parts.near));
      ASSERT_EQ(of_whole.distance[i], least(of_parts.distance));
      ASSERT_EQ(of_whole.deepest[i], least(of_parts.deepest));
      // Bodies in slabs are solid, also where time is concerned.
      std::vector<std::uint8_t> crossing(pieces.x.size());
      collide(apart, pieces.agents(), obstacles, crossing);
      float time = least(of_parts.time);
      for (std::size_t p = 0; p < crossing.size(); ++p)
        if (of_parts.hits[p] != 0 && crossing[p] == 0) time = 0;
      ASSERT_EQ(of_whole.time[i], time);
      float depth = 0;
      for (const Penetration& way_out : of_parts.ways) depth = std::max(depth, way_out.depth);
      ASSERT_EQ(of_whole.ways[i].depth, depth);
      // The disc's number counts those of the parts before.
      const auto nearest = std::find(of_parts.deepest.begin(), of_parts.deepest.end(), of_whole.deepest[i]) -
                           of_parts.deepest.begin();
      std::uint32_t before = 0;
      for (std::ptrdiff_t p = 0; p < nearest; ++p)
        before += static_cast<std::uint32_t>(
            apart.discs(pieces.shape[static_cast<std::size_t>(p)], crowd.level[i]).size());
      const auto& of_part = of_parts.deepest_discs[static_cast<std::size_t>(nearest)];
      ASSERT_EQ(of_whole.deepest_discs[i], (DiscPair{before + of_part.first, of_part.second}));
      hits += of_whole.hits[i];
    }
  }
  EXPECT_GT(hits, test::samples(1'000));
}

}  // namespace
}  // namespace bch
