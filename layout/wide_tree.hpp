// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <vector>

#include "layout/hierarchy.hpp"
#include "layout/shape_set_view.hpp"

namespace bch {

/// One cut of a hierarchy as a tree of blocks over the cut's discs. Every inner disc encloses the cut discs below
/// it, with the slack that rounding.hpp derives, so that pruning by it changes no answer.
struct WideTree {
  /// Up to eight groups of cut discs side by side; what is left over is padding. `child`: a block of this tree, or
  /// leaf_window + the index of the first of eight discs, which hold the group and, where it has fewer, some of
  /// its neighbours: harmless, because every disc of the cut may be tested at any time.
  struct Block {
    DiscBlock discs;
    std::uint32_t child[block_width];
  };
  std::vector<Block> blocks;
  std::vector<Disc> discs;  ///< the cut in depth-first order; padded to eight where there are fewer
  std::uint32_t top;        ///< as `child`
  Disc root;                ///< encloses the cut discs; the cut's disc itself where there is only one
  bool is_single;           ///< the cut is one disc
};

/// Collapses the binary tree above a cut: a block's groups come from expanding its node's descendant with most
/// discs until there are eight groups, or all fit into one window each. Where that would need more than
/// most_wide_levels, the cut's discs are grouped evenly in their order instead.
WideTree wide_tree(const Hierarchy& hierarchy, std::uint32_t depth);

}  // namespace bch
