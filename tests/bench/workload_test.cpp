// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/workload/workload.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace bch::bench {
namespace {

/// Where all of a shape is its root disc, no pair's root discs overlap while its hierarchies do not.
TEST(RandomPairs, GivesUpWhereNoneIsWanted) {
  const std::vector<Shape> shapes = {{{}, fixed_cylinder(0.25f)}};
  std::uint32_t asked = 0;
  try {
    random_pairs("no_hit", 1, shapes, 10, [&](const Agents&, Pair) { return ++asked <= 3; });
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()),
              "workload no_hit: of 1000000 pairs at random after the first 3 none is wanted");
  }
}

TEST(RandomPairs, HasAsManyAsAreWanted) {
  const std::vector<Shape> shapes = {{{}, fixed_cylinder(0.25f)}};
  std::uint32_t asked = 0;
  const Workload workload =
      random_pairs("every third", 1, shapes, 10, [&](const Agents&, Pair) { return ++asked % 3 == 0; });
  EXPECT_EQ(workload.pairs.size(), 10u);
  EXPECT_EQ(workload.crowd.size(), 20u);
  EXPECT_EQ(asked, 30u);
}

}  // namespace
}  // namespace bch::bench
