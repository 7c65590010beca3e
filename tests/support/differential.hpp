// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <gtest/gtest.h>

#include "baselines/reference.hpp"
#include "tests/support/scenes.hpp"

namespace bch::test {

/// The levels of sets for distance queries.
inline const ShapeSetPlan four_levels{{0, 3, 6, all_depths}};

/// The fixture for comparisons of kernels with references: shapes of many kinds, and pairs of them.
class Differential : public testing::Test {
 protected:
  Differential(std::uint64_t seed, const ShapeSetPlan& levels)
      : shapes(synthetic_shapes(seed, 40)),
        set(shapes, levels),
        discs(shapes, levels),
        random(seed + 1),
        seed_(seed) {}

  void SetUp() override { RecordProperty("seed", std::to_string(seed_)); }

  /// Makes pairs that stand at the edge of an overlap of discs.
  PairScene tangent_scene(std::uint32_t pairs) {
    PairScene scene = random_scene(random, set, pairs);
    make_tangent(random, scene, [&](const Agents& agents, Pair pair) {
      return discs.boundary(agents, pair, baselines::Method::depth_first);
    });
    return scene;
  }

  std::vector<Shape> shapes;
  ShapeSet set;
  baselines::Reference discs;
  Random random;

 private:
  std::uint64_t seed_;
};

}  // namespace bch::test
