// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/stability/stability.hpp"
#include "tests/support/test.hpp"

// What the kernel's chapter says to who makes a depth the spring of a force, on a small scale.

namespace bch::bench {
namespace {

void expect_discs_to_begin_at_nothing(const StiffRow& row) {
  EXPECT_LT(row.largest_onset, 0.0015) << row.cut;  // a step's way
  if (row.cut == "0") {
    EXPECT_LT(row.most_energy, 0.002);
    // Springs alone are stable up to 2 / omega of two masses.
    const double bound = 2 / std::sqrt(2 * 1.2e5 / 80);
    EXPECT_GT(row.two_step, 0.75 * bound);
    EXPECT_LT(row.two_step, 1.35 * bound);
  }
  if (row.cut == "3") {
    EXPECT_LT(row.most_energy, 0.03);
  }
}

TEST(StiffContact, IsWhatTheChapterSays) {
  const std::vector<StiffRow> rows = stiff_rows(2, 25);
  ASSERT_EQ(rows.size(), 8u);
  for (const StiffRow& row : rows) {
    EXPECT_GT(row.bounces, 15u);
    if (row.law == "deepest discs") expect_discs_to_begin_at_nothing(row);
  }
  const StiffRow& penetration = rows[3];
  ASSERT_EQ(penetration.law + " " + penetration.cut, "penetration all");
  EXPECT_GT(penetration.largest_onset, 0.02);
  EXPECT_GT(penetration.most_energy, 0.1);
}

}  // namespace
}  // namespace bch::bench
