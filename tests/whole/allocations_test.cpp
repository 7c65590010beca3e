// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/allocation_count.hpp"
#include "tests/support/c_api_queries.hpp"
#include "tests/support/crowd_pairs.hpp"
#include "tests/support/test.hpp"

// Queries of pairs need no memory, and objects keep theirs: those of the C interface, and what they call of the C++ library.

namespace bch {
namespace {

/// By the number of threads that calls ask for.
class Allocations : public testing::TestWithParam<std::uint32_t> {
 protected:
  /// Of later calls, the first being over.
  static std::size_t count(const test::CQuery& query) {
    test::expect_ok(query.ask());
    const std::size_t before = test::allocation_count();
    for (int i = 0; i < 5; ++i) test::expect_ok(query.ask());
    return test::allocation_count() - before;
  }

  static void expect_none(const ShapeSet& set, double step) {
    test::Random random(53);
    test::Crowd crowd;
    for (int i = 0; i < 1'500; ++i) {
      crowd.add({random.below(16), random.uniform(0, 67), random.uniform(0, 67), random.uniform(-4, 4),
                 static_cast<std::uint8_t>(random.below(3))});
      if (step > 0) crowd.z.push_back(step * (i % 4));
    }
    std::vector<Pair> pairs = test::candidate_pairs(set, crowd.agents());
    ASSERT_GT(pairs.size(), 1'000u);
    pairs.resize(1'000);
    test::CScene scene(set, crowd, pairs);
    scene.options.threads = GetParam();
    for (const bool other : {false, true}) {
      scene.options.distance_leaves = other;
      scene.options.implementation = other ? "scalar" : nullptr;
      for (const test::CQuery& query : all_queries(scene)) {
        const std::size_t counted = count(query);
        EXPECT_EQ(counted > 0, query.needs_memory) << query.name << ": " << counted;
      }
    }
  }

  const std::vector<Shape> bodies = test::synthetic_shapes(54, 16);
};

TEST_P(Allocations, BodiesOnOneGround) {
  expect_none(ShapeSet(bodies, {{0, 3, all_depths}, true}), 0);
}

TEST_P(Allocations, BodiesAtDifferentHeights) {
  std::vector<Shape> high = bodies;
  for (Shape& body : high) body.heights = {0, 0.5f};
  expect_none(ShapeSet(high, {.depths = {0, 3, all_depths}, .heights = true}), 0.3);
}

INSTANTIATE_TEST_SUITE_P(Threads, Allocations, testing::Values(0, 1, 2, 4),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace bch
