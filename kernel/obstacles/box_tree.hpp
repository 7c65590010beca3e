// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "layout/base/aligned_vector.hpp"

namespace bch::detail {

/// Holds the boxes of eight children; unused ones are from infinity to -infinity and overlap nothing.
struct BoxBlock {
  double low_x[8], low_y[8], high_x[8], high_y[8];
};

constexpr std::uint32_t max_box_levels = 11;  ///< 8^11 is 2^33 boxes

/// Represents a tree of boxes, eight per block. Block 8 b + i of a level has the boxes inside box i of block b of the
/// level above. On level 0, box i of block b is the box number order[8 b + i] of the input (BoxTreeMemory::order).
struct BoxTreeView {
  const BoxBlock* blocks;
  std::uint32_t level_begin[max_box_levels];
  std::uint32_t levels;  ///< 0: there are no boxes
};

/// Represents a rectangle of the world, metres.
struct Box {
  double low_x, low_y, high_x, high_y;
};

/// Represents a tree of boxes and its memory. The object cannot be copied or moved, because `view` points into it.
struct BoxTreeMemory {
  explicit BoxTreeMemory(std::span<const Box> boxes);
  BoxTreeMemory(const BoxTreeMemory&) = delete;

  std::vector<std::uint32_t> order;  ///< the box of each place in the tree
  AlignedVector<BoxBlock> blocks;
  BoxTreeView view;
};

/// Holds the index of a query, and of a block or a box of a level.
struct BoxHit {
  std::uint32_t query, place;
};

/// Searches a tree for boxes near a point, the nearest first, and reuses its memory.
class NearestBoxes {
 public:
  /// Calls take(place) for the boxes whose squared distance from a point is below `limit`. take() may lower `limit`.
  /// Boxes of near blocks come first.
  template <class Take>
  void visit(const BoxTreeView& tree, double x, double y, const double& limit, const Take& take) {
    open_.clear();
    if (tree.levels != 0) open_.push_back({0, tree.levels - 1, 0});
    while (!open_.empty() && open_.front().square < limit) {
      const auto [of_block, level, block] = open_.front();
      std::pop_heap(open_.begin(), open_.end());
      open_.pop_back();
      const BoxBlock& boxes = tree.blocks[tree.level_begin[level] + block];
      for (std::uint32_t i = 0; i < 8; ++i) {
        const double square = square_distance(boxes, i, x, y);
        if (!(square < limit)) continue;
        const std::uint32_t below = 8 * block + i;
        if (level == 0) {
          take(below);
          continue;
        }
        open_.push_back({square, level - 1, below});
        std::push_heap(open_.begin(), open_.end());
      }
    }
  }

 private:
  /// Represents a block, and the squared distance of its box from the point. If blocks are equally near, the one of
  /// the lowest level comes first.
  struct OpenBlock {
    double square;
    std::uint32_t level, block;
    bool operator<(const OpenBlock& other) const noexcept {
      return square != other.square ? square > other.square : level > other.level;
    }
  };

  /// Returns the squared distance of a point from a box of a block; infinity from an unused one.
  static double square_distance(const BoxBlock& block, std::uint32_t i, double x, double y) noexcept {
    const double dx = std::max(std::max(block.low_x[i] - x, x - block.high_x[i]), 0.0),
                 dy = std::max(std::max(block.low_y[i] - y, y - block.high_y[i]), 0.0);
    return dx * dx + dy * dy;
  }

  std::vector<OpenBlock> open_;  ///< a heap: the nearest first
};

}  // namespace bch::detail
