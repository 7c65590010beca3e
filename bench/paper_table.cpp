// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <vector>

#include "bench/ratios.hpp"

namespace bch::bench {
namespace {

/// A structure that the paper timed, what it took there in microseconds, and those here that answer the same.
struct Row {
  std::string_view what;
  double paper;  ///< 0: not in the paper
  std::string_view kind;
};

constexpr std::string_view kernel_row = "";
constexpr Row rows[] = {
    {"BCH, outline, this batch kernel", 0, kernel_row},
    {"BCH, outline, one pair after the other", 2.66, "reference"},
    {"OBB tree, outline", 4.63, "obb_contour"},
    {"OBB tree, outline, rectangles in 2D", 0, "obb_contour_2d"},
    {"OBB tree, outline, FCL's", 0, "fcl_obb_contour"},
    {"OBB tree, all triangles seen from above", 20.66, "obb_projected"},
};

constexpr std::string_view columns[] = {"paper500", "paper500_cached", "colliding"};

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
      contenders.push_back(row.kind == kernel_row ? kernel_contender(scene, workload, Semantics::boundary,
                                                                     kernel::best_implementation())
                                                  : structure_contender(scene, workload, row.kind));
    race(contenders, runs, 1);
    for (std::size_t i = 0; i < there.size(); ++i)
      nanoseconds[i].push_back(contenders[i].nanoseconds / static_cast<double>(workload.pairs.size()));
  }

  fmt::print(
      "| ns per colliding pair, one thread | paper | 500 pairs in sequence | 500, each repeated | distinct "
      "pairs |\n");
  fmt::print("|---|---|---|---|---|\n");
  for (std::size_t i = 0; i < there.size(); ++i) {
    fmt::print("| {} | {} |", there[i].what,
               there[i].paper > 0 ? fmt::format("{:.0f}", 1000 * there[i].paper) : "");
    for (const double time : nanoseconds[i]) fmt::print(" {:.0f} |", time);
    fmt::print("\n");
  }
}

}  // namespace bch::bench
