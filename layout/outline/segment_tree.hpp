// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "layout/outline/grid_box.hpp"
#include "layout/outline/segment_search.hpp"

namespace bch::detail {

/// Represents a point that need not be on the grid, in grid steps.
struct GridPlace {
  double x, y;
};

/// Represents a binary tree over segments. It is for so many segments that SegmentBoxes, which has only two levels,
/// would be slow. A node has a box around its segments, and also a slab (the space between two parallel lines) around
/// them, parallel to the longest segment. If the segments are parallel and close to each other, their slab is thin,
/// whatever their direction.
class SegmentTree {
 public:
  /// Builds the tree over segments, which must stay unchanged until the last find(). The search is fast only if
  /// consecutive segments of the array are near each other in the plane.
  void assign(std::span<const Segment> segments);

  /// Writes the numbers of all segments that come within a grid step of the line between two places, in ascending
  /// order, and perhaps of some others. `near` has room for all segments.
  /// Returns: how many were written.
  std::size_t find(GridPlace from, GridPlace to, std::uint32_t* near) const;

 private:
  struct Node {
    GridBox box;
    double normal_x, normal_y, low,
        high;       ///< the slab: a unit vector, and the interval of the segments along it
    double length;  ///< of the segment to which the slab is parallel
  };

  void set_leaf(Node& node, std::span<const Segment> segments) const;
  void set_slab(Node& node, std::span<const Segment> segments) const;

  std::span<const Segment> segments_;
  std::size_t leaves_ = 0;   ///< a power of two
  std::vector<Node> nodes_;  ///< the children of node i are 2 i and 2 i + 1; leaves from leaves_ on
};

}  // namespace bch::detail
