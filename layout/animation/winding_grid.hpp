// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "layout/base/plane_point.hpp"

namespace bch::detail {

/// Tells of rectangles whether closed polygons go round all of them: the plane in square cells, of which each is inside if no edge
/// meets it and polygons go round it a number of times other than 0.
class WindingGrid {
 public:
  /// Takes polygons: the corners of one after the other, and where each ends.
  void set(std::span<const PlanePoint> corners, std::span<const std::uint32_t> ends);

  /// Returns whether all cells of a rectangle are inside.
  bool holds(const PlanePoint& low, const PlanePoint& high) const;

 private:
  void add_crossings(const PlanePoint& from, const PlanePoint& to);
  void mark_cells(const PlanePoint& from, const PlanePoint& to);
  double column(double x) const { return (x - low_.x) / cell_; }
  double row(double y) const { return (y - low_.y) / cell_; }

  double cell_ = 1;  ///< the side of a cell, metres
  PlanePoint low_;
  std::int64_t columns_ = 0, rows_ = 0;
  std::vector<std::int32_t>
      turns_;  ///< per cell, behind a row and a column of zeros; then how many cells up to it are not inside
  std::vector<std::uint8_t> met_;  ///< per cell: an edge meets it
};

}  // namespace bch::detail
