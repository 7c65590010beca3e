// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/obstacles/distance_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "kernel/obstacles/segment.hpp"
#include "kernel/runtime/task_ranges.hpp"

namespace bch::detail {
namespace {

constexpr double beyond_all = std::numeric_limits<double>::infinity();
constexpr double huge = 1e30;  // metres
constexpr double cells_per_segment = 4, least_cells = 256;
/// Cells are measured by squares of so many a side, because their nearest segments are few and soon found together.
constexpr std::size_t cells_together = 4;

/// Finds the segments one of which is the nearest one of any point in a disc.
class NearestSegments {
 public:
  NearestSegments(const BoxTreeView& tree, std::span<const WorldSegment> segments) noexcept
      : tree_(tree), segments_(segments) {}

  /// Looks about a disc. Returns: whether it was done; segments that cross each other all over take too long.
  bool search(double x, double y, double radius) {
    constexpr std::size_t too_many = 200;
    found_.clear();
    double least = beyond_all, limit = beyond_all;
    boxes_.visit(tree_, x, y, limit, [&](std::uint32_t slot) {
      found_.push_back(slot);
      const double square = segments_[slot].square_distance(x, y);
      if (found_.size() > too_many) limit = 0;
      if (!(square < least) || limit == 0) return;
      // The nearest one of a point in the disc is at most twice the radius farther from the centre than the nearest one there.
      const double most = std::sqrt(square) + 2 * radius;
      least = square, limit = most * most;
    });
    return found_.size() <= too_many;
  }

  double distance(double x, double y) const noexcept {
    double least = beyond_all;
    for (const std::uint32_t slot : found_) least = std::min(least, segments_[slot].square_distance(x, y));
    return std::sqrt(least);
  }

 private:
  const BoxTreeView& tree_;
  std::span<const WorldSegment> segments_;
  NearestBoxes boxes_;
  std::vector<std::uint32_t> found_;
};

Box box_of_all(const BoxTreeView& tree) {
  const BoxBlock& top = tree.blocks[tree.level_begin[tree.levels - 1]];
  return {*std::min_element(top.low_x, top.low_x + 8), *std::min_element(top.low_y, top.low_y + 8),
          *std::max_element(top.high_x, top.high_x + 8), *std::max_element(top.high_y, top.high_y + 8)};
}

/// Measures squares of cells from left to right.
void measure_rows(const DistanceGridView& view, std::uint8_t* steps, std::size_t row, std::size_t rows,
                  NearestSegments& near) {
  constexpr double middle = (cells_together - 1) / 2.0, most = DistanceGridView::far;
  const double radius = middle * std::sqrt(2.0) * view.side * (1 + 0x1p-20) + view.rounding;
  const auto x = [&](double column) { return view.x + column * view.side; };
  const auto y = [&](double at) { return view.y + at * view.side; };
  for (std::size_t column = 0; column < view.columns; column += cells_together) {
    const bool is_done =
        near.search(x(static_cast<double>(column) + middle), y(static_cast<double>(row) + middle), radius);
    for (std::size_t r = row; r < std::min(row + cells_together, rows); ++r)
      for (std::size_t c = column; c < std::min(column + cells_together, view.columns); ++c) {
        const double distance =
            is_done ? near.distance(x(static_cast<double>(c)), y(static_cast<double>(r))) : 0;
        steps[r * view.columns + c] = static_cast<std::uint8_t>(std::min(distance / view.step, most));
      }
  }
}

}  // namespace

DistanceGridMemory::DistanceGridMemory(const BoxTreeView& tree, std::span<const WorldSegment> segments) {
  if (segments.empty()) {
    steps.assign(1, DistanceGridView::far);
    view = {0, 0, huge, 1 / huge, huge, 0, 0, 1, steps.data(), 0};
    return;
  }
  const Box all = box_of_all(tree);
  const double width = all.high_x - all.low_x, height = all.high_y - all.low_y;
  const double cells = cells_per_segment * static_cast<double>(segments.size()) + least_cells;
  view.side = std::max({std::sqrt(width * height / cells), std::max(width, height) / cells, 1e-6});
  view.per_metre = 1 / view.side, view.step = view.side / DistanceGridView::steps_a_side;
  view.x = all.low_x + view.side / 2, view.y = all.low_y + view.side / 2;
  view.last_column = std::floor(width * view.per_metre), view.last_row = std::floor(height * view.per_metre);
  view.columns = static_cast<std::size_t>(view.last_column) + 1;
  view.rounding = 0x1p-46 * (std::abs(all.low_x) + std::abs(all.low_y) + width + height);
  const std::size_t rows = static_cast<std::size_t>(view.last_row) + 1;
  steps.resize(view.columns * rows);
  constexpr std::size_t grain = 16;
  for_ranges((rows + cells_together - 1) / cells_together, grain, [&](std::size_t begin, std::size_t end) {
    NearestSegments near(tree, segments);
    for (std::size_t i = begin; i < end; ++i)
      measure_rows(view, steps.data(), i * cells_together, rows, near);
  });
  view.steps = steps.data();
}

}  // namespace bch::detail
