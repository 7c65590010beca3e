// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/lab/stability_report.hpp"

#include <fmt/format.h>

namespace bch::cli {
namespace {

using bench::Errors;
using bench::falsely_hit;
using bench::largest_error;
using bench::missed;
using bench::StabilityFamily;
using bench::StabilityRow;

struct Test {
  const char *name, *key;
  Errors StabilityRow::*errors;
};
constexpr Test tests[] = {{"plain float", "float", &StabilityRow::plain_float},
                          {"plain double", "double", &StabilityRow::plain_double},
                          {"bch", "bch", &StabilityRow::ours}};

std::string errors_text(const StabilityRow& row, const Errors& errors) {
  return fmt::format(" | {:>6.2f} {:>6.2f} {:>8.1e}", missed(row, errors), falsely_hit(row, errors),
                     largest_error(errors));
}

std::string line(const StabilityRow& row) {
  if (!row.refused.empty()) return fmt::format("{:>32}   refused: {}\n", row.value, row.refused);
  std::string out = fmt::format("{:>32} {:>6} {:>6}", row.value, row.pairs, row.meeting);
  for (const Test& test : tests) out += errors_text(row, row.*test.errors);
  return out + fmt::format(" | {:>6} {:>6}\n", row.outlines_meeting, row.outline_misses);
}

std::vector<const StabilityRow*> of_family(const StabilityFamily& family,
                                           std::span<const StabilityRow> rows) {
  std::vector<const StabilityRow*> found;
  for (const StabilityRow& row : rows)
    if (row.family == family.name) found.push_back(&row);
  return found;
}

}  // namespace

std::string text_of(std::span<const StabilityRow> rows) {
  std::string out =
      "Of each test: missed contacts, % of those that meet; false hits, % of those that do not; the largest "
      "error, metres per metre of reach.\nOf outlines that are about to touch: how many meet, and how many "
      "of those "
      "bch misses.\n";
  for (const StabilityFamily& family : bench::stability_families()) {
    out += fmt::format("\n{}{}{}\n{:>32} {:>6} {:>6}", family.title, family.axis ? ": " : "",
                       family.axis ? family.axis : "", "", "pairs", "meet");
    for (const Test& test : tests) out += fmt::format(" | {:^22}", test.name);
    out += " | outlines\n";
    for (const StabilityRow* row : of_family(family, rows)) out += line(*row);
  }
  return out;
}

report::Table table_of(std::span<const StabilityRow> rows) {
  std::vector<std::string> columns = {"family", "value", "conditioning", "pairs", "meeting"};
  for (const Test& test : tests)
    for (const char* column :
         {"misses", "false_positives", "deepest_miss_m", "largest_gap_m", "miss_per_reach", "gap_per_reach"})
      columns.push_back(fmt::format("{}_{}", test.key, column));
  columns.insert(columns.end(), {"outlines", "outlines_meeting", "outline_misses", "refused"});
  report::Table table(columns);
  for (const StabilityRow& row : rows) {
    std::vector<report::Cell> cells = {row.family, row.value, row.conditioning, row.pairs, row.meeting};
    for (const Test& test : tests) {
      const Errors& e = row.*test.errors;
      cells.insert(cells.end(), {e.misses, e.false_positives, e.deepest_miss, e.largest_gap, e.miss_per_reach,
                                 e.gap_per_reach});
    }
    cells.insert(cells.end(), {row.outlines, row.outlines_meeting, row.outline_misses, row.refused});
    table.add(cells);
  }
  return table;
}

}  // namespace bch::cli
