// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <vector>

#include "layout/aligned_vector.hpp"
#include "layout/segment_search.hpp"

namespace bch {

/// Boxes around segments, 16 to a block, and around blocks, 16 to a block again, until few blocks are left.
/// The order of the segments makes the blocks: neighbours should be near each other.
class BoxTree {
 public:
  /// Room for that many segments, so that assign() allocates nothing.
  void reserve(std::size_t segments);

  /// The segments are followed by copies of the last one, up to a whole block.
  void assign(const Segment* segments, std::size_t count);

  /// Sets where the search finds the boxes, until the next assign().
  void describe(SegmentSearch& search) const;

 private:
  static constexpr std::size_t top_blocks = 8, top_group = 4;

  void lay_out(std::size_t segments);
  void pad(std::size_t count, std::size_t level);

  AlignedVector<BoxBlock> blocks_;
  std::vector<std::size_t> level_begin_;  ///< first block of each level, segments' own first; and the end
};

}  // namespace bch
