// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/stability/tables.hpp"

#include <algorithm>

namespace bch::bench {
namespace {

struct Test {
  const char* key;
  Errors StabilityRow::*errors;
};
constexpr Test tests[] = {{"float", &StabilityRow::plain_float},
                          {"double", &StabilityRow::plain_double},
                          {"bch", &StabilityRow::ours}};

}  // namespace

std::string text_of(std::span<const StabilityRow> rows) {
  std::string out = fmt::format(
      "{:<34} {:>7} {:>7}  {:^20}  {:^28}  outlines\n{:<34} {:>7} {:>7}  {:>6} {:>6} {:>6}  {:>8}  {:>8}  "
      "{:>8}  {:>6}  {:>7}\n",
      "", "pairs", "that", "contacts missed by", "largest error, um/m of reach", "", "", "meet", "float",
      "double", "bch", "float", "double", "bch", "missed", "refused");
  for (const StabilityFamily& family : stability_families()) {
    std::uint64_t pairs = 0, meeting = 0, outlines = 0, refused = 0, misses[std::size(tests)] = {};
    double errors[std::size(tests)] = {};
    for (const StabilityRow& row : rows) {
      if (row.family != family.name) continue;
      pairs += row.pairs, meeting += row.meeting, outlines += row.outline_misses,
          refused += !row.refused.empty();
      for (std::size_t i = 0; i < std::size(tests); ++i) {
        misses[i] += (row.*tests[i].errors).misses;
        errors[i] = std::max(errors[i], 1e6 * largest_error(row.*tests[i].errors));
      }
    }
    out += fmt::format("{:<34} {:>7} {:>7}  {:>6} {:>6} {:>6}  {:>8.2g}  {:>8.2g}  {:>8.2g}  {:>6}  {:>7}\n",
                       family.title, pairs, meeting, misses[0], misses[1], misses[2], errors[0], errors[1],
                       errors[2], outlines, refused);
  }
  return out;
}

Table table_of(std::span<const StabilityRow> rows) {
  std::vector<Cell> columns = {"family", "title", "axis", "value", "conditioning", "pairs", "meeting"};
  for (const Test& test : tests)
    for (const char* column : {"misses", "false hits", "deepest miss (m)", "largest gap (m)",
                               "deepest miss (m/m of reach)", "largest gap (m/m of reach)"})
      columns.push_back(fmt::format("{}: {}", test.key, column));
  columns.insert(columns.end(), {"outlines", "outlines meeting", "outline misses", "refused"});
  Table table(columns);
  for (const StabilityRow& row : rows) {
    const auto family = std::ranges::find(stability_families(), row.family, &StabilityFamily::name);
    std::vector<Cell> cells = {row.family, family->title,    family->axis ? family->axis : "",
                               row.value,  row.conditioning, row.pairs,
                               row.meeting};
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

std::string text_of(const StiffReport& report) {
  std::string out =
      "Stiff contact: 80 kg, k = 1.2e5 kg/s2, kappa = 2.4e5 kg/(m s), semi-implicit Euler\n"
      "depth from       cut  largest stable step (0: below 2 ms)    first touch  energy created  turn in a "
      "step\n";
  for (std::size_t i = 0; i < report.bounces.size(); ++i) {
    const BounceRow& bounce = report.bounces[i];
    std::string steps;
    for (const StiffRow& row : report.rows)
      if (row.measure == bounce.measure && row.depth == bounce.depth)
        steps += fmt::format("{}{} {:.0f} ms", steps.empty() ? "" : ", ", row.scene, 1e3 * row.largest_step);
    out +=
        fmt::format("{:<15} {:>4}  {}  {:>5.1f} mm {:>7.2f} % {:>9.3f} rad\n", name_of(bounce.measure),
                    bounce.depth, steps, 1e3 * bounce.onset, 100 * bounce.energy, report.slides.at(i).turn);
  }
  return out;
}

Table press_table(const StiffReport& report) {
  Table table({"depth from", "cut", "scene", "2/omega (ms)", "largest stable step (ms)", "jitter (m/s)"});
  for (const StiffRow& row : report.rows)
    table.add(
        {name_of(row.measure), row.depth, row.scene, 1000 * row.bound, 1000 * row.largest_step, row.jitter});
  return table;
}

Table touch_table(const StiffReport& report) {
  Table table({"depth from", "cut", "bounces", "depth at first touch (mm)", "largest of these (mm)",
               "energy created (%)", "energy, most (%)", "change by motion", "depth jump (mm)",
               "turn in a step (rad)"});
  for (std::size_t i = 0; i < report.bounces.size(); ++i) {
    const BounceRow& bounce = report.bounces[i];
    const SlideRow& slide = report.slides.at(i);
    table.add({name_of(bounce.measure), bounce.depth, bounce.bounces, 1000 * bounce.onset,
               1000 * bounce.largest_onset, 100 * bounce.energy, 100 * bounce.most_energy, slide.change,
               1000 * slide.jump, slide.turn});
  }
  return table;
}

}  // namespace bch::bench
