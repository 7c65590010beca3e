// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/cli/stiff_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/base/chart.hpp"

namespace bch::cli {
namespace {

using bench::BounceRow;
using bench::DepthMeasure;
using bench::SlideRow;
using bench::StiffReport;
using bench::StiffRow;

/// Returns the place of a depth on an axis: "all" comes after 6.
double place_of(const std::string& depth) {
  return depth == "all" ? 9 : std::stod(depth);
}

/// Makes a panel of the rows that a filter lets through, with a line for each measure.
template <class Row, class Keep, class Value>
ChartPanel panel(const std::vector<Row>& rows, std::string title, bool logarithmic, Keep keep, Value value) {
  ChartPanel made;
  made.title = std::move(title);
  std::vector<double> ys;
  for (const DepthMeasure measure : {DepthMeasure::penetration, DepthMeasure::discs, DepthMeasure::centres}) {
    ChartSeries& series = made.series.emplace_back(ChartSeries{name_of(measure), {}});
    for (const Row& row : rows)
      if (row.measure == measure && keep(row)) {
        series.points.push_back({place_of(row.depth), value(row)});
        ys.push_back(series.points.back().y);
      }
  }
  made.x = {"depth of the cut; all: at 9", false, 0, 9, false};
  made.y = axis_for("", logarithmic, ys);
  return made;
}

}  // namespace

std::string text_of(const StiffReport& report) {
  std::string out =
      "Stiff contact: 80 kg, k = 1.2e5 kg/s2, kappa = 2.4e5 kg/(m s), semi-implicit Euler\n"
      "scene            depth  measure          2 / omega  largest stable step  jitter at rest\n";
  for (const StiffRow& row : report.rows)
    out += fmt::format("{:<16} {:>5}  {:<15} {:>7.1f} ms {:>17} {:>15}\n", row.scene, row.depth,
                       name_of(row.measure), row.bound * 1e3,
                       row.largest_step > 0 ? fmt::format("{:.0f} ms", row.largest_step * 1e3) : "below 2 ms",
                       row.jitter > 0 ? fmt::format("{:.2f} mm/s", row.jitter * 1e3) : "-");
  out +=
      "\nTwo agents bounce at 1 m/s          depth at the beginning     energy created\n"
      "depth  measure          bounces     mean    largest        mean size    largest\n";
  for (const BounceRow& row : report.bounces)
    out += fmt::format("{:>5}  {:<15} {:>8} {:>5.1f} mm {:>7.1f} mm {:>14.2f} % {:>8.1f} %\n", row.depth,
                       name_of(row.measure), row.bounces, row.onset * 1e3, row.largest_onset * 1e3,
                       row.energy * 100, row.most_energy * 100);
  out +=
      "\nTwo agents slide over each other by 0.1 mm a step\n"
      "depth  measure          largest change of depth  by the motion  of direction\n";
  for (const SlideRow& row : report.slides)
    out += fmt::format("{:>5}  {:<15} {:>20.3f} mm {:>14.2f} {:>9.3f} rad\n", row.depth, name_of(row.measure),
                       row.jump * 1e3, row.change, row.turn);
  return out;
}

std::string csv_of(const StiffReport& report) {
  std::string out =
      "measure,depth,kind,scene,bound_s,largest_step_s,jitter_m_s,bounces,onset_m,largest_onset_m,"
      "energy,most_energy,depth_change,depth_jump_m,turn_rad\n";
  for (const StiffRow& row : report.rows)
    out += fmt::format("{},{},press,{},{},{},{},,,,,,,,\n", name_of(row.measure), row.depth, row.scene,
                       row.bound, row.largest_step, row.jitter);
  for (const BounceRow& row : report.bounces)
    out += fmt::format("{},{},bounce,,,,,{},{},{},{},{},,,\n", name_of(row.measure), row.depth, row.bounces,
                       row.onset, row.largest_onset, row.energy, row.most_energy);
  for (const SlideRow& row : report.slides)
    out += fmt::format("{},{},slide,,,,,,,,,,{},{},{}\n", name_of(row.measure), row.depth, row.change,
                       row.jump, row.turn);
  return out;
}

nlohmann::ordered_json json_of(const StiffReport& report) {
  using nlohmann::ordered_json;
  ordered_json presses = ordered_json::array(), bounces = presses, slides = presses;
  for (const StiffRow& row : report.rows)
    presses.push_back({{"scene", row.scene},
                       {"depth", row.depth},
                       {"measure", name_of(row.measure)},
                       {"bound", row.bound},
                       {"largest_step", row.largest_step},
                       {"jitter", row.jitter}});
  for (const BounceRow& row : report.bounces)
    bounces.push_back({{"depth", row.depth},
                       {"measure", name_of(row.measure)},
                       {"bounces", row.bounces},
                       {"onset", row.onset},
                       {"largest_onset", row.largest_onset},
                       {"energy", row.energy},
                       {"most_energy", row.most_energy}});
  for (const SlideRow& row : report.slides)
    slides.push_back({{"depth", row.depth},
                      {"measure", name_of(row.measure)},
                      {"change", row.change},
                      {"jump", row.jump},
                      {"turn", row.turn}});
  return {{"presses", presses}, {"bounces", bounces}, {"slides", slides}};
}

std::string draw_steps(const StiffReport& report) {
  std::vector<ChartPanel> panels;
  for (const StiffRow& first : report.rows) {
    if (std::any_of(panels.begin(), panels.end(),
                    [&](const ChartPanel& panel) { return panel.title.starts_with(first.scene); }))
      continue;
    panels.push_back(panel(
        report.rows, first.scene + ", ms", false,
        [&](const StiffRow& row) { return row.scene == first.scene; },
        [](const StiffRow& row) { return row.largest_step * 1e3; }));
    panels.back().y.high = 50;
    panels.back().line = first.bound * 1e3;
    panels.back().line_name = "2 / omega of the springs";
  }
  return draw_chart("Stiff contact: the largest stable time step", panels);
}

std::string draw_errors(const StiffReport& report) {
  const auto every = [](const auto&) { return true; };
  const std::vector<ChartPanel> panels = {
      panel(report.bounces, "Largest depth at the first touch, m", true, every,
            [](const BounceRow& row) { return row.largest_onset; }),
      panel(report.bounces, "Energy created by a bounce, part, mean", true, every,
            [](const BounceRow& row) { return row.energy; }),
      panel(
          report.rows, "Jitter of two agents at rest, m/s", true,
          [&](const StiffRow& row) { return row.scene == report.rows.front().scene; },
          [](const StiffRow& row) { return row.jitter; })};
  return draw_chart("Stiff contact: what a depth adds that is not there", panels);
}

}  // namespace bch::cli
