// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/stability/stiff_contact.hpp"

#include "tests/support/test.hpp"

// What the README says to who makes a depth the spring of a force, on a small scale.

namespace bch::bench {
namespace {

const StiffReport& report() {
  static const StiffReport made = stiff_contact({1.5, 0, 25, 25});
  return made;
}

template <class Row>
const Row& find(const std::vector<Row>& rows, const char* depth, DepthMeasure measure) {
  for (const Row& row : rows)
    if (row.depth == depth && row.measure == measure) return row;
  throw std::out_of_range(depth);
}

void expect_continuous_depths() {
  for (const char* depth : {"0", "3", "6", "all"})
    for (const DepthMeasure measure : {DepthMeasure::penetration, DepthMeasure::discs}) {
      const SlideRow& row = find(report().slides, depth, measure);
      EXPECT_LE(row.change, 1.01) << depth << " " << name_of(measure);
      EXPECT_GT(row.change, 0.5);
    }
  EXPECT_GT(find(report().slides, "all", DepthMeasure::penetration).turn, 0.5);
  EXPECT_LT(find(report().slides, "all", DepthMeasure::centres).turn, 0.01);
}

void expect_discs_to_begin_at_nothing() {
  for (const BounceRow& row : report().bounces) EXPECT_GT(row.bounces, 15u);
  for (const char* depth : {"0", "3", "6", "all"})
    EXPECT_LT(find(report().bounces, depth, DepthMeasure::discs).largest_onset, 0.0015)
        << depth;  // a step's way
  EXPECT_GT(find(report().bounces, "all", DepthMeasure::penetration).largest_onset, 0.02);
}

void expect_little_energy_of_coarse_discs() {
  EXPECT_LT(find(report().bounces, "0", DepthMeasure::discs).most_energy, 0.002);
  EXPECT_LT(find(report().bounces, "3", DepthMeasure::discs).most_energy, 0.03);
}

void expect_stability_up_to_the_bound() {
  const StiffRow& two = find(report().rows, "0", DepthMeasure::discs);
  ASSERT_EQ(two.scene, "two agents");
  EXPECT_NEAR(two.bound, 0.0365, 1e-4);
  EXPECT_GT(two.largest_step, 0.75 * two.bound);
  EXPECT_LT(two.largest_step, 1.35 * two.bound);
}

/// One test, because everything is simulated but once for it.
TEST(StiffContact, IsWhatTheReadmeSays) {
  expect_continuous_depths();
  expect_discs_to_begin_at_nothing();
  expect_little_energy_of_coarse_discs();
  expect_stability_up_to_the_bound();
}

}  // namespace
}  // namespace bch::bench
