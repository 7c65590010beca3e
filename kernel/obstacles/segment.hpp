// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "kernel/obstacles/box_tree.hpp"
#include "kernel/obstacles/distance_grid.hpp"

namespace bch::detail {

/// Represents a segment of an obstacle in the frame of an agent, by its line: a point has coordinates `along` it and
/// `across` it.
///
/// Rounding, with the notation of layout/base/rounding.hpp. All is done in double.
///
///   - Headings are within 3e-10 of the exact ones. That moves points of the agent, which are within its extent P, by
///     0.006 u P. Enlarged radii allow for 16.5 u P (contact_error).
///   - Let d be the distance of the segment's ends from the agent. The subtraction of positions, the direction (three
///     roundings), two products and a sum are off by 2^-53 |d| for each rounding, together by less than 8 * 2^-53 |d|.
///     `slack` is twice that.
///
/// So a disc whose outline meets the segment passes touches(), and a gap is never larger than that of the outlines.
struct LocalSegment {
  double x, y;      ///< the unit vector along it
  double offset;    ///< `across` of the line, from the agent's position
  double from, to;  ///< `along` of its ends
  double slack;     ///< metres
  std::uint32_t slot, number, obstacle;

  template <class Real>
  [[gnu::always_inline]] Real along(Real at_x, Real at_y) const noexcept {
    return Real(x) * at_x + Real(y) * at_y;
  }
  template <class Real>
  [[gnu::always_inline]] Real across(Real at_x, Real at_y) const noexcept {
    return Real(x) * at_y - Real(y) * at_x - Real(offset);
  }
  /// Returns the squared distance from a point, by the same operations as a lane of ObstacleKernel.
  [[gnu::always_inline]] double square_distance(double at_x, double at_y) const noexcept {
    const double at = along(at_x, at_y), aside = across(at_x, at_y);
    const double before = from - at, behind = at - to;
    double beyond = before < behind ? behind : before;
    beyond = beyond < 0 ? 0 : beyond;
    return aside * aside + beyond * beyond;
  }
  [[gnu::always_inline]] bool touches(double at_x, double at_y, double radius) const noexcept {
    const double limit = radius + slack;
    return square_distance(at_x, at_y) <= limit * limit;
  }
};

/// Returns whether one of `count` segments touches a disc. (Inlined for certain, so that instruction sets share no
/// function.)
[[gnu::always_inline]] inline bool any_touches(const LocalSegment* segments, std::size_t count, double x,
                                               double y, double radius) noexcept {
  for (std::size_t i = 0; i < count; ++i)
    if (segments[i].touches(x, y, radius)) return true;
  return false;
}

constexpr double relative_slack = 0x1p-49;
static_assert(relative_slack >= 2 * 8 * 0x1p-53);

/// Represents a segment in the world: its ends, the unit vector from the one to the other, which is (1, 0) where they
/// are the same, and its length, metres.
struct WorldSegment {
  double ax, ay, bx, by;
  double x, y, length;
  std::uint32_t number, obstacle;

  /// Returns the squared distance from a point of the world. LocalSegment has the same, apart from rounding; for one
  /// point and many segments, this saves rotating each.
  double square_distance(double at_x, double at_y) const noexcept {
    const double dx = at_x - ax, dy = at_y - ay;
    const double along = dx * x + dy * y, across = dx * y - dy * x;
    const double beyond = std::max(std::max(-along, along - length), 0.0);
    return across * across + beyond * beyond;
  }
};

/// Holds the range of heights of an obstacle in the world, metres.
struct WorldHeights {
  double bottom, top;
};

/// Holds all of an ObstacleSet. A segment's slot is its index in the tree, its number that in the caller's arrays.
struct ObstacleView {
  BoxTreeView segment_tree, area_tree;  ///< of the boxes of segments and of areas
  DistanceGridView distance_grid;       ///< of the segments
  const WorldSegment* segments;         ///< by slot
  const std::uint8_t* is_area;          ///< by obstacle
  const WorldHeights* heights;          ///< by obstacle; null: all heights
  const std::uint8_t* begins_polyline;  ///< by number
  const std::int16_t*
      outside;         ///< by number: the side of it that is outside of its area, 1 the left one; 0 of a line
  double widest_area;  ///< metres: no area holds a disc with a larger diameter
  const std::uint32_t* areas;  ///< by slot of the tree of areas: the obstacle
  const Box* area_boxes;       ///< by the same slot
  std::uint32_t segment_count, obstacle_count;
};

}  // namespace bch::detail
