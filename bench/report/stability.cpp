// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/stability/stability.hpp"

#include <algorithm>
#include <stdexcept>

#include "bench/report/report.hpp"

// Where tests of discs fail: hard cases, by exact arithmetic; and depths as springs.

namespace bch::report {
namespace {

using bench::Errors;
using bench::StabilityRow;

struct Test {
  const char* key;
  Errors StabilityRow::*errors;
};
constexpr Test tests[] = {{"float", &StabilityRow::plain_float},
                          {"double", &StabilityRow::plain_double},
                          {"bch", &StabilityRow::ours}};

/// Returns a row for each value, with columns for all that was measured.
Table table_of(std::span<const StabilityRow> rows) {
  std::vector<Cell> columns = {"family", "title", "axis", "value", "conditioning", "pairs", "meeting"};
  for (const Test& test : tests)
    for (const char* column : {"misses", "false hits", "deepest miss (m)", "largest gap (m)",
                               "deepest miss (m/m of extent)", "largest gap (m/m of extent)"})
      columns.push_back(fmt::format("{}: {}", test.key, column));
  columns.insert(columns.end(), {"outlines", "outlines meeting", "outline misses", "refused"});
  Table table(columns);
  for (const StabilityRow& row : rows) {
    const auto family =
        std::ranges::find(bench::stability_families(), row.family, &bench::StabilityFamily::name);
    std::vector<Cell> cells = {row.family, family->title,    family->axis ? family->axis : "",
                               row.value,  row.conditioning, row.pairs,
                               row.meeting};
    for (const Test& test : tests) {
      const Errors& e = row.*test.errors;
      cells.insert(cells.end(), {e.misses, e.false_positives, e.deepest_miss, e.largest_gap,
                                 e.miss_per_extent, e.gap_per_extent});
    }
    cells.insert(cells.end(), {row.outlines, row.outlines_meeting, row.outline_misses, row.refused});
    table.add(cells);
  }
  return table;
}

}  // namespace

void run_stability(Run& run) {
  const auto rows = bench::stability_rows(run.sizes().contacts, run.seed());
  run.write("stability", table_of(rows));
  for (const StabilityRow& row : rows)
    if (const std::string broken = broken_promise(row); !broken.empty())
      throw std::runtime_error("a promise is broken: " + broken);
}

void run_stiff(Run& run) {
  Table table({"depth from", "cut", "bounces", "first touch (mm)", "first touch, most (mm)", "energy (%)",
               "energy, most (%)", "step: two (ms)", "step: a row (ms)", "step: a door (ms)"});
  for (const bench::StiffRow& row : bench::stiff_rows(run.sizes().people / 5, run.sizes().cases / 5))
    table.add({row.law, row.cut, row.bounces, 1e3 * row.onset, 1e3 * row.largest_onset, 100 * row.energy,
               100 * row.max_energy, 1e3 * row.two_step, 1e3 * row.row_step, 1e3 * row.door_step});
  run.write("stiff", table);
}

}  // namespace bch::report
