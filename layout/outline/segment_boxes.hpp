// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>

#include "layout/base/aligned_vector.hpp"
#include "layout/outline/segment_search.hpp"

namespace bch::detail {

/// Holds the boxes around segments, 16 per block, and the boxes around blocks, 16 per group. Blocks follow the order
/// of the segments, so neighbouring segments should be near each other.
class SegmentBoxes {
 public:
  /// Reserves memory for this many segments, so that assign() allocates nothing.
  void reserve(std::size_t segments);

  /// Builds the boxes of segments. Copies of the last segment must follow them, up to a whole block.
  void assign(const Segment* segments, std::size_t count);

  /// Returns the lexicographically smallest end of all segments. Only blocks that reach the first column of cells can
  /// have it.
  GridPoint first_end(const Segment* segments) const;

  /// Sets the pointers of a search to these boxes, valid until the next assign().
  void describe(SegmentSearch& search) const;

 private:
  AlignedVector<BoxBlock> blocks_, groups_;
};

}  // namespace bch::detail
