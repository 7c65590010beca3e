// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/stability/stability.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/report/experiment.hpp"
#include "bench/report/words.hpp"
#include "bench/stability/stiff_contact.hpp"

// Measures where tests of discs fail, and how depths behave as springs.

namespace bch::report {
namespace {

constexpr double milliseconds = 1000;

double micrometres(const bench::Errors& errors) {
  return 1e6 * bench::largest_error(errors);
}

void add_family(const bench::StabilityFamily& family, const std::vector<bench::StabilityRow>& rows,
                Table& table, Table& refused) {
  for (const bench::StabilityRow& row : rows) {
    if (row.family != family.name) continue;
    if (!row.refused.empty()) {
      refused.add({fmt::format("{}: {}", family.title, row.value), row.refused});
      continue;
    }
    table.add({family.name, row.value, row.pairs, row.meeting, bench::missed(row, row.plain_float),
               bench::missed(row, row.plain_double), bench::missed(row, row.ours),
               bench::falsely_hit(row, row.plain_float), bench::falsely_hit(row, row.plain_double),
               bench::falsely_hit(row, row.ours), micrometres(row.plain_float), micrometres(row.plain_double),
               micrometres(row.ours), row.outlines_meeting, row.outline_misses});
  }
}

void add_rows(Run& run) {
  const std::vector<bench::StabilityRow> rows = bench::stability_rows(run.sizes().contacts, run.seed());
  Table table({"family", "value", "pairs near contact", "of them meeting", "float: missed (%)",
               "double: missed (%)", "bch: missed (%)", "float: false hits (%)", "double: false hits (%)",
               "bch: false hits (%)", "float: largest error (um/m)", "double: largest error (um/m)",
               "bch: largest error (um/m)", "outlines that meet", "outlines missed by bch"});
  Table refused({"case", "exception"});
  for (const bench::StabilityFamily& family : bench::stability_families())
    add_family(family, rows, table, refused);
  run.write("stability", table);
  run.write("stability_refused", refused);
}

void add_stiff(Run& run) {
  const std::uint32_t each = std::max(2u, run.sizes().cases / 5);
  const bench::StiffReport report = bench::stiff_contact({.seconds = run.sizes().pressed,
                                                          .people = std::min(200u, run.sizes().people),
                                                          .bounces = each,
                                                          .slides = each});
  Table press({"depth from", "cut", "scene", "2/omega (ms)", "largest stable step (ms)", "jitter (m/s)"});
  for (const bench::StiffRow& row : report.rows)
    press.add({name_of(row.measure), row.depth, row.scene, milliseconds * row.bound,
               milliseconds * row.largest_step, row.jitter});
  Table touch({"depth from", "cut", "depth at first touch (mm)", "energy created (%)", "energy, most (%)",
               "change by motion", "turn in a step (rad)"});
  for (std::size_t i = 0; i < report.bounces.size(); ++i) {
    const bench::BounceRow& bounce = report.bounces[i];
    const bench::SlideRow& slide = report.slides.at(i);
    touch.add({name_of(bounce.measure), bounce.depth, millimetres * bounce.onset, 100 * bounce.energy,
               100 * bounce.most_energy, slide.change, slide.turn});
  }
  run.write("stiff_press", press);
  run.write("stiff_touch", touch);
}

void run_stability(Run& run) {
  add_rows(run);
  run.done(0.5);
  add_stiff(run);
}

double most(const Table& table, std::string_view column) {
  double found = 0;
  for (std::size_t i = 0; i < table.rows().size(); ++i) found = std::max(found, table.number(i, column));
  return found;
}

}  // namespace

const Experiment stability_experiment{
    "stability",
    "Stability",
    200,
    false,
    run_stability,
    {{"most of", [](const Results& results,
                    std::string_view column) { return brief(most(results("stability"), column)); }},
     {"energy created",
      [](const Results& results, std::string_view) {
        return brief(most(results("stiff_touch"), "energy created (%)"));
      }},
     {"refused values", [](const Results& results, std::string_view) {
        return fmt::format("{}", results("stability_refused").rows().size());
      }}}};

}  // namespace bch::report
