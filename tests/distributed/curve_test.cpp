// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/distributed/curve.hpp"

#include <cstdlib>

#include "kernel/distributed/cut.hpp"
#include "tests/support/test.hpp"

namespace bch::detail {
namespace {

TEST(Curve, GoesFromSquareToSquareThroughAll) {
  struct Step {
    std::uint64_t key;
    Cell cell;
  };
  std::vector<Step> steps;
  for (std::int32_t y = 0; y < 64; ++y)
    for (std::int32_t x = 0; x < 64; ++x) steps.push_back({curve_key({x - 192, y + 1024}), {x, y}});
  std::ranges::sort(steps, {}, &Step::key);
  for (std::size_t i = 1; i < steps.size(); ++i) {
    EXPECT_EQ(steps[i].key, steps[i - 1].key + 1);
    EXPECT_EQ(
        std::abs(steps[i].cell.x - steps[i - 1].cell.x) + std::abs(steps[i].cell.y - steps[i - 1].cell.y), 1);
  }
}

TEST(Curve, SquaresHoldTheirLowerBorders) {
  EXPECT_EQ(cell_at(0, -0.0, 2), (Cell{0, 0}));
  EXPECT_EQ(cell_at(2, -1e-300, 2), (Cell{1, -1}));
  EXPECT_EQ(cell_at(-2, 1e9, 2), (Cell{-1, 500'000'000}));
}

TEST(Cut, PartsWeighTheSameButForAPlace) {
  test::Random random(4);
  for (const int ranks : {1, 2, 3, 7, 16, 1024}) {
    std::vector<Weight> weights;
    std::uint64_t total = 0, largest = 0;
    for (int i = 0; i < 3000; ++i) {
      weights.push_back({random.next(), random.below(1000)});
      total += weights.back().weight, largest = std::max(largest, weights.back().weight);
    }
    std::ranges::sort(weights, {}, &Weight::key);
    const std::vector<Weight> places = weights;
    const Cut cut = cut_evenly(ranks, weight_before(weights));
    EXPECT_EQ(cut.firsts().size() + 1, static_cast<std::size_t>(ranks));
    EXPECT_TRUE(std::ranges::is_sorted(cut.firsts()));
    std::vector<std::uint64_t> sums(static_cast<std::size_t>(ranks), 0);
    for (const Weight& place : places) sums[static_cast<std::size_t>(cut.owner(place.key))] += place.weight;
    EXPECT_LE(*std::ranges::max_element(sums), total / static_cast<std::uint64_t>(ranks) + 1 + largest);
    EXPECT_EQ(std::accumulate(sums.begin(), sums.end(), std::uint64_t{0}), total);
  }
}

TEST(Cut, NothingNeedsNoPlace) {
  std::vector<Weight> none;
  const Cut cut = cut_evenly(5, weight_before(none));
  EXPECT_EQ(cut.firsts().size(), 4u);
  EXPECT_EQ(cut.owner(0), 4);  // whoever it is
}

}  // namespace
}  // namespace bch::detail
