// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/lab/stiff_report.hpp"

#include <fmt/format.h>

namespace bch::cli {
namespace {

using bench::BounceRow;
using bench::DepthMeasure;
using bench::SlideRow;
using bench::StiffReport;
using bench::StiffRow;

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

report::Table table_of(const StiffReport& report) {
  report::Table table({"measure", "depth", "kind", "scene", "bound_s", "largest_step_s", "jitter_m_s",
                       "bounces", "onset_m", "largest_onset_m", "energy", "most_energy", "depth_change",
                       "depth_jump_m", "turn_rad"});
  for (const StiffRow& row : report.rows)
    table.add({name_of(row.measure), row.depth, "press", row.scene, row.bound, row.largest_step, row.jitter,
               "", "", "", "", "", "", "", ""});
  for (const BounceRow& row : report.bounces)
    table.add({name_of(row.measure), row.depth, "bounce", "", "", "", "", row.bounces, row.onset,
               row.largest_onset, row.energy, row.most_energy, "", "", ""});
  for (const SlideRow& row : report.slides)
    table.add({name_of(row.measure), row.depth, "slide", "", "", "", "", "", "", "", "", "", row.change,
               row.jump, row.turn});
  return table;
}

}  // namespace bch::cli
