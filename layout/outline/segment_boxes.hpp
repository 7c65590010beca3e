// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>

#include "layout/base/aligned_vector.hpp"
#include "layout/outline/segment_search.hpp"

namespace bch::detail {

/// Holds the boxes around segments, 16 to a block, and around blocks, 16 to a group. The order of the segments
/// makes the blocks: neighbours should be near each other.
class SegmentBoxes {
 public:
  /// Reserves room for that many segments, so that assign() allocates nothing.
  void reserve(std::size_t segments);

  /// Builds the boxes of segments, which are followed by copies of the last one, up to a whole block.
  void assign(const Segment* segments, std::size_t count);

  /// Returns the segments' lexicographically smallest end: only blocks that reach the first column of cells have it.
  GridPoint first_end(const Segment* segments) const;

  /// Sets where the search finds the boxes, until the next assign().
  void describe(SegmentSearch& search) const;

 private:
  AlignedVector<BoxBlock> blocks_, groups_;
};

}  // namespace bch::detail
