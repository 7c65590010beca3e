// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/animation/winding_grid.hpp"

#include <algorithm>
#include <cmath>

#include "layout/base/ring_edges.hpp"

namespace bch::detail {
namespace {

constexpr double cells_across = 128;  ///< the longer side

}  // namespace

void WindingGrid::set(std::span<const PlanePoint> corners, std::span<const std::uint32_t> ends) {
  PlanePoint high = corners[0];
  low_ = corners[0];
  for (const PlanePoint& p : corners) {
    low_ = lower(low_, p);
    high = upper(high, p);
  }
  cell_ = std::max({(high.x - low_.x) / cells_across, (high.y - low_.y) / cells_across, 1e-9});
  low_ = low_ - PlanePoint{cell_, cell_};
  // A row and a column of zeros come first, for sums.
  columns_ = static_cast<std::int64_t>(column(high.x)) + 2;
  rows_ = static_cast<std::int64_t>(row(high.y)) + 2;
  turns_.assign(static_cast<std::size_t>((columns_ + 1) * (rows_ + 1)), 0);
  met_.assign(turns_.size(), 0);
  for_each_ring_edge(ends, [&](std::uint32_t i, std::uint32_t next) {
    add_crossings(corners[i], corners[next]);
    mark_cells(corners[i], corners[next]);
  });
  for (std::int64_t r = 0; r < rows_; ++r) {
    std::int32_t turns = 0, outer = 0;
    for (std::int64_t c = 0; c < columns_; ++c) {
      const auto i = static_cast<std::size_t>((r + 1) * (columns_ + 1) + c + 1);
      turns += turns_[i];
      outer += turns == 0 || met_[i] != 0;
      turns_[i] = outer + turns_[i - static_cast<std::size_t>(columns_ + 1)];
    }
  }
}

/// Counts an edge in the rows whose middle it crosses, from the first cell whose middle is to its right.
void WindingGrid::add_crossings(const PlanePoint& from, const PlanePoint& to) {
  if (from.y == to.y) return;
  const bool up = to.y > from.y;
  const PlanePoint &a = up ? from : to, &b = up ? to : from;
  const auto first = static_cast<std::int64_t>(std::ceil(row(a.y) - 0.5));
  const auto end = static_cast<std::int64_t>(std::ceil(row(b.y) - 0.5));
  for (std::int64_t r = first; r < end; ++r) {
    const double y = low_.y + (static_cast<double>(r) + 0.5) * cell_;
    const double x = a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
    const auto c =
        std::clamp<std::int64_t>(static_cast<std::int64_t>(std::ceil(column(x) - 0.5)), 0, columns_ - 1);
    turns_[static_cast<std::size_t>((r + 1) * (columns_ + 1) + c + 1)] += up ? -1 : 1;
  }
}

/// Marks the cells that an edge meets, and those that it meets but for rounding.
void WindingGrid::mark_cells(const PlanePoint& from, const PlanePoint& to) {
  constexpr double more = 1e-6;  // cells
  const bool up = to.y > from.y;
  const PlanePoint &a = up ? from : to, &b = up ? to : from;
  const double top = row(b.y) + more, bottom = row(a.y) - more, height = row(b.y) - row(a.y);
  for (auto r = static_cast<std::int64_t>(bottom); r <= static_cast<std::int64_t>(top); ++r) {
    double begin = column(a.x), end = column(b.x);
    if (height > 1e-3) {
      const double slope = (end - begin) / height, at_a = begin;
      const double low = std::max(static_cast<double>(r), row(a.y)) - row(a.y);
      const double high = std::min(static_cast<double>(r + 1), row(b.y)) - row(a.y);
      begin = at_a + slope * low;
      end = at_a + slope * high;
    }
    if (begin > end) std::swap(begin, end);
    const auto last = static_cast<std::int64_t>(end + more);
    for (auto c = static_cast<std::int64_t>(begin - more); c <= last; ++c)
      met_[static_cast<std::size_t>((r + 1) * (columns_ + 1) + c + 1)] = 1;
  }
}

bool WindingGrid::holds(const PlanePoint& low, const PlanePoint& high) const {
  const double left = column(low.x), right = column(high.x), bottom = row(low.y), top = row(high.y);
  if (!(left >= 0 && bottom >= 0 && right < static_cast<double>(columns_) &&
        top < static_cast<double>(rows_)))
    return false;
  const auto c = static_cast<std::int64_t>(left), r = static_cast<std::int64_t>(bottom);
  const auto c_end = static_cast<std::int64_t>(right) + 1, r_end = static_cast<std::int64_t>(top) + 1;
  const auto sum = [&](std::int64_t row_end, std::int64_t column_end) {
    return turns_[static_cast<std::size_t>(row_end * (columns_ + 1) + column_end)];
  };
  return sum(r_end, c_end) - sum(r, c_end) - sum(r_end, c) + sum(r, c) == 0;
}

}  // namespace bch::detail
