// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace bch::detail {

struct BoxTreeView;
struct WorldSegment;

/// Bounds the distance of a point from the nearest segment, metres; the upper bound may be infinite. (A search that finds
/// nothing searches farther.)
struct DistanceBounds {
  double least, most;
};

/// Holds the distances of the centres of square cells from the nearest segment, one byte each, so that they stay in near caches.
/// A point at `distance` from a centre is at most `distance` nearer to a segment or farther from it, inside or outside of the
/// grid. So one number shows which agents have nothing near them, and how far the others have to search.
struct DistanceGridView {
  static constexpr double steps_a_side = 16;
  static constexpr std::uint8_t far = 255;  ///< 255 steps or more

  double x, y;             ///< metres: the centre of the first cell
  double side, per_metre;  ///< of a cell, and 1 / side
  double step;             ///< metres
  double last_column, last_row;
  std::size_t columns;
  const std::uint8_t* steps;  ///< by row and column, rounded down; 0 also if too many segments are near
  double
      rounding;  ///< metres, above the rounding of the largest coordinates in a bound and the slack of segments

  /// Returns bounds of the distance of a point, whose coordinates are finite, from the nearest segment.
  [[gnu::always_inline]] DistanceBounds bounds(double at_x, double at_y) const noexcept {
    const double column = nearest_of((at_x - x) * per_metre, last_column),
                 row = nearest_of((at_y - y) * per_metre, last_row);
    const double dx = at_x - (x + column * side), dy = at_y - (y + row * side);
    const double distance = __builtin_sqrt(dx * dx + dy * dy);
    const std::size_t cell = static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column);
    const double from_centre = step * steps[cell];
    const double off = rounding + 0x1p-20 * (from_centre + distance) +
                       0x1p-47 * (__builtin_fabs(at_x) + __builtin_fabs(at_y));
    const double most = steps[cell] == far ? __builtin_inf() : from_centre + step;
    return {from_centre - distance - off, most + distance + off};
  }

 private:
  /// Returns the nearest whole number from 0 to `last`.
  [[gnu::always_inline]] static double nearest_of(double v, double last) noexcept {
    v = v < 0 ? 0 : v;
    v = v > last ? last : v;
    const double half_more = v + 0.5;
    return static_cast<double>(static_cast<std::int64_t>(half_more));
  }
};

/// Represents a grid of distances and its memory; it does not move.
struct DistanceGridMemory {
  /// Measures the grid of segments, which are in the order of the tree of their boxes.
  DistanceGridMemory(const BoxTreeView& tree, std::span<const WorldSegment> segments);
  DistanceGridMemory(const DistanceGridMemory&) = delete;

  std::vector<std::uint8_t> steps;
  DistanceGridView view;
};

}  // namespace bch::detail
