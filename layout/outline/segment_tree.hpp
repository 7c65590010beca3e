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

/// Represents a point between points of the grid, in steps.
struct GridPlace {
  double x, y;
};

/// Represents a binary tree over segments, for so many of them that SegmentBoxes's two levels would be slow. A node has a box and a
/// slab around its segments, the latter along its longest segment: parallel segments close to each other are long and
/// thin, whatever their direction.
class SegmentTree {
 public:
  /// Builds the tree over segments, which must stay as they are until the last find(). Neighbours should be
  /// near each other.
  void assign(std::span<const Segment> segments);

  /// Writes the numbers of segments that may come within a step of the line between two places, all that do, in
  /// ascending order. `near` has room for all segments.
  /// Returns: how many were written.
  std::size_t find(GridPlace from, GridPlace to, std::uint32_t* near) const;

 private:
  struct Node {
    GridBox box;
    double normal_x, normal_y, low, high;  ///< of unit length, and how far ends are along it
    double length;                         ///< of the segment that the normal is of
  };

  void set_leaf(Node& node, std::span<const Segment> segments) const;
  void set_slab(Node& node, std::span<const Segment> segments) const;

  std::span<const Segment> segments_;
  std::size_t leaves_ = 0;   ///< a power of two
  std::vector<Node> nodes_;  ///< the children of node i are 2 i and 2 i + 1; leaves from leaves_ on
};

}  // namespace bch::detail
