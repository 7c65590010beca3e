// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

namespace bch::detail {

/// Holds boxes around the eight nodes below one; what is left over is padding that overlaps nothing: from infinity to
/// -infinity.
struct BoxBlock {
  double low_x[8], low_y[8], high_x[8], high_y[8];
};

constexpr std::uint32_t max_box_levels = 11;  ///< 8^11 is 2^33 boxes

/// Represents a tree of boxes in the order of its leaves, eight children a node: child i of block b is block 8 b + i of the level below, of
/// level 0 box 8 b + i of what the tree was made of.
struct BoxTreeView {
  const BoxBlock* blocks;
  std::uint32_t level_begin[max_box_levels];
  std::uint32_t levels;  ///< 0: there are no boxes
};

/// Represents a rectangle of the world, metres.
struct Box {
  double low_x, low_y, high_x, high_y;
};

/// Represents a node of a tree, or one of its boxes, and the number of the query that asks about it.
struct BoxHit {
  std::uint32_t query, place;
};

}  // namespace bch::detail
