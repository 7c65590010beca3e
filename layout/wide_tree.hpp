// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "layout/hierarchy.hpp"
#include "layout/shape_set_view.hpp"

namespace bch {

/// Up to eight discs side by side: first those that stand for a block of their own, then discs of the cut,
/// then padding that overlaps nothing (infinitely far away; a negative radius would hit, because the sum of
/// radii is squared).
struct WideBlock {
  std::array<float, block_width> x = filled(std::numeric_limits<float>::infinity());
  std::array<float, block_width> y = filled(0);
  std::array<float, block_width> radius = filled(0);
  std::uint32_t first_child = 0;  ///< block of disc 0; the further inner discs' blocks follow it
  std::uint8_t inner_count = 0;

 private:
  static std::array<float, block_width> filled(float value) {
    std::array<float, block_width> values;
    values.fill(value);
    return values;
  }
};

/// One cut of a hierarchy as a tree of blocks, block 0 the root. Every inner disc encloses the cut discs
/// below it, with the slack that rounding.hpp derives, so that pruning by it changes no answer.
struct WideTree {
  Disc root;       ///< encloses the cut discs; the cut's disc itself where there is only one
  bool is_single;  ///< the cut is one disc
  std::vector<WideBlock> blocks;
};

/// Collapses the binary tree above a cut: a block's discs come from expanding its node's descendant with most
/// discs until there are eight, or all fit into one block each. Where that would need more than
/// most_wide_levels, the cut's discs are grouped evenly in their order instead.
WideTree wide_tree(const Hierarchy& hierarchy, std::uint32_t depth);

}  // namespace bch
