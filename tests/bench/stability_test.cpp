// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/stability/stability.hpp"
#include "tests/support/test.hpp"

// The hard cases of `bch stability`, few pairs of each. That they are hard is part of what is tested: plain tests in float and
// in double have to fail there.

namespace bch::bench {
namespace {

const std::vector<StabilityRow>& rows() {
  static const std::vector<StabilityRow> all = stability_rows(200);
  return all;
}

template <class Value>
std::uint64_t sum(Value value, const char* family = nullptr) {
  std::uint64_t total = 0;
  for (const StabilityRow& row : rows())
    if (!family || row.family == family) total += value(row);
  return total;
}

TEST(Stability, EveryPromiseHolds) {
  for (const StabilityRow& row : rows()) EXPECT_EQ(broken_promise(row), "");
}

void expect_both_answers(const StabilityFamily& family) {
  const auto pairs = sum([](const StabilityRow& row) { return row.pairs; }, family.name);
  const auto meeting = sum([](const StabilityRow& row) { return row.meeting; }, family.name);
  EXPECT_GT(meeting, pairs / 10) << family.name;
  if (std::string(family.name) != "coincident") {
    EXPECT_LT(meeting, pairs) << family.name;
  }
}

TEST(Stability, CasesAreHard) {
  for (const StabilityFamily& family : stability_families()) expect_both_answers(family);
  const auto outlines = sum([](const StabilityRow& row) { return row.outlines; });
  const auto outlines_meeting = sum([](const StabilityRow& row) { return row.outlines_meeting; });
  EXPECT_GT(outlines_meeting, outlines / 10);
  EXPECT_LT(outlines_meeting, outlines * 9 / 10);
  EXPECT_GT(sum([](const StabilityRow& row) { return row.plain_float.misses; }), 100u);
  EXPECT_GT(sum([](const StabilityRow& row) { return row.plain_double.misses; }, "ladder_double"), 10u);
  EXPECT_GT(sum([](const StabilityRow& row) { return row.plain_double.false_positives; }, "ladder_double"),
            10u);
  // What is outside the domain is refused by a sentence.
  EXPECT_GE(sum([](const StabilityRow& row) { return row.outside; }), 12u);
  for (const StabilityRow& row : rows())
    if (row.outside) {
      EXPECT_GT(row.refused.size(), 20u) << row.family << " " << row.value;
    }
}

TEST(Stability, RowsAreTheSameEachTime) {
  const std::vector<StabilityRow> again = stability_rows(200);
  ASSERT_EQ(again.size(), rows().size());
  for (std::size_t i = 0; i < again.size(); ++i) {
    EXPECT_EQ(again[i].meeting, rows()[i].meeting);
    EXPECT_EQ(again[i].plain_float.misses, rows()[i].plain_float.misses);
    EXPECT_EQ(again[i].ours.largest_gap, rows()[i].ours.largest_gap);
  }
}

// ---- What the kernel's chapter says to who makes a depth the spring of a force, on a small scale.

void expect_discs_to_begin_at_nothing(const StiffRow& row) {
  EXPECT_LT(row.largest_onset, 0.0015) << row.cut;  // a step's way
  if (row.cut == "0") {
    EXPECT_LT(row.max_energy, 0.002);
    // Springs alone are stable up to 2 / omega of two masses.
    const double bound = 2 / std::sqrt(2 * 1.2e5 / 80);
    EXPECT_GT(row.two_step, 0.75 * bound);
    EXPECT_LT(row.two_step, 1.35 * bound);
  }
  if (row.cut == "3") {
    EXPECT_LT(row.max_energy, 0.03);
  }
}

TEST(StiffContact, IsWhatTheChapterSays) {
  const std::vector<StiffRow> rows = stiff_rows(2, 25);
  ASSERT_EQ(rows.size(), 12u);
  for (const StiffRow& row : rows) {
    EXPECT_GT(row.bounces, 15u);
    if (row.law == "deepest discs") expect_discs_to_begin_at_nothing(row);
  }
  const StiffRow& penetration = rows[3];
  ASSERT_EQ(penetration.law + " " + penetration.cut, "penetration all");
  EXPECT_GT(penetration.largest_onset, 0.02);
  EXPECT_GT(penetration.max_energy, 0.1);
  const StiffRow& nearest_free = rows[7];
  ASSERT_EQ(nearest_free.law + " " + nearest_free.cut, "nearest free all");
  EXPECT_LT(nearest_free.largest_onset, 0.003);
  EXPECT_LT(nearest_free.energy, 0.06);
}

}  // namespace
}  // namespace bch::bench
