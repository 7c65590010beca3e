// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "bench/ratios/ratios.hpp"
#include "bench/workload/race.hpp"

namespace bch::bench {
namespace {

/// What the paper timed, and what here answers the same.
struct Row {
  std::string_view what;
  double paper;  ///< nanoseconds there; 0: not in the paper
  std::string_view kind;
};

constexpr std::string_view kernel_row = "", plain_row = "reference";
constexpr Row rows[] = {
    {"BCH, outline, this batch kernel", 0, kernel_row},
    {"BCH, outline, one pair after the other", 2660, plain_row},
    {"OBB tree, outline", 4630, "obb_contour"},
    {"OBB tree, outline, rectangles in 2D", 0, "obb_contour_2d"},
    {"OBB tree, outline, FCL's, two triangles a segment", 0, "fcl_obb_contour"},
    {"OBB tree, outline, FCL's, one triangle a segment", 0, "fcl_obb_segments"},
    {"OBB tree, all triangles seen from above", 20660, "obb_projected"},
};

constexpr std::string_view columns[] = {"paper500", "paper500_cached", "colliding"};

/// Writes a time and its ratio to the scalar reference's time; that ratio does not depend on the hardware.
std::string cell(double nanoseconds, double plain) {
  if (!(nanoseconds > 0)) return {};
  const double ratio = nanoseconds / plain;
  return ratio < 10 ? fmt::format("{:.0f} ({:.2g} x)", nanoseconds, ratio)
                    : fmt::format("{:.0f} ({:.0f} x)", nanoseconds, ratio);
}

}  // namespace

void print_paper_table(Scene& scene, std::uint32_t runs) {
  std::vector<Row> there;
  for (const Row& row : rows)
    if (row.kind == kernel_row || has_kind(row.kind)) there.push_back(row);
  std::vector<std::vector<double>> nanoseconds(there.size());
  for (const std::string_view column : columns) {
    const Workload& workload = scene.workload(column);
    std::vector<Contender> contenders;
    for (const Row& row : there)
      contenders.push_back(row.kind == kernel_row
                               ? kernel_contender(scene, workload, disc_query, kernel::best_implementation())
                               : structure_contender(scene, workload, row.kind));
    race(contenders, runs, 1);
    for (std::size_t i = 0; i < there.size(); ++i)
      nanoseconds[i].push_back(contenders[i].nanoseconds / static_cast<double>(workload.pairs.size()));
  }

  fmt::print(
      "\n| ns per colliding pair, one thread | paper | 500 pairs in sequence | 500, each repeated | "
      "distinct pairs |\n|---|---|---|---|---|\n");
  const auto plain = static_cast<std::size_t>(
      std::find_if(there.begin(), there.end(), [](const Row& row) { return row.kind == plain_row; }) -
      there.begin());
  for (std::size_t i = 0; i < there.size(); ++i) {
    fmt::print("| {} | {} |", there[i].what, cell(there[i].paper, there[plain].paper));
    for (std::size_t k = 0; k < std::size(columns); ++k)
      fmt::print(" {} |", cell(nanoseconds[i][k], nanoseconds[plain][k]));
    fmt::print("\n");
  }
}

}  // namespace bch::bench
