// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "layout/hierarchy.hpp"
#include "layout/profile.hpp"
#include "layout/shape_set_view.hpp"
#include "layout/supports.hpp"

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
  std::vector<float> x, y, radius;  ///< the cut in depth-first order; padded to eight where there are fewer
  std::uint32_t top;                ///< as `child`
  Disc root;                        ///< encloses the cut discs; the cut's disc itself where there is only one
  bool is_single;                   ///< the cut is one disc
};

/// Collapses the binary tree above a cut: a block's groups come from expanding descendants of its node, those of many
/// and large discs first, until there are eight groups or nothing to expand. What fits into a window becomes one.
/// Where that would need more than most_wide_levels, the cut's discs are grouped evenly in their order instead.
WideTree wide_tree(const Hierarchy& hierarchy, std::uint32_t depth);

/// The same for several cuts of one hierarchy after the other, with memory that is reused: once it has seen
/// the largest, nothing is allocated. Not for two threads at a time.
class Flattener {
 public:
  /// The hierarchy has to live until the next call.
  void begin(const Hierarchy& hierarchy);
  /// Makes a cut the current one and collapses the tree above it.
  void flatten(std::uint32_t depth, WideTree& tree);
  /// Of the current cut's discs.
  Supports supports() const;
  Outer outer(const Profile& profile) const;

 private:
  /// A run of the cut's discs, and where it is a subtree of the binary tree, that subtree's root.
  struct Group {
    std::uint32_t begin, end;  ///< in the list of cut discs
    std::uint32_t node;        ///< of the hierarchy; used by subtree grouping only

    std::uint32_t size() const { return end - begin; }
  };
  static bool is_window(const Group& group) { return group.size() <= block_width; }
  /// What becomes one block.
  struct Parts {
    std::array<Group, block_width> group;
    std::array<double, block_width> worth;  ///< of expanding each; subtree grouping only
    std::uint32_t count = 0;
  };
  /// A node whose part of the cut is to be found so many levels below, or sooner.
  struct Open {
    std::uint32_t node, left;
  };
  using Split = Parts (Flattener::*)(const Group&) const;

  void cut(std::uint32_t depth);
  bool grow(Split split, WideTree& tree);
  std::uint32_t window(const Group& group) const;
  Parts subtrees(const Group& group) const;
  Parts even_runs(const Group& group) const;
  void expand(Parts& parts, std::uint32_t index) const;
  Disc enclosing(const Group& group) const;
  double worth(const Group& group) const;

  const Hierarchy* hierarchy_ = nullptr;
  std::vector<Open> open_;
  std::vector<std::uint32_t> position_;  ///< per node on or above the cut: the first of its discs
  std::uint32_t count_ = 0;              ///< discs of the cut
  std::vector<float> x_, y_, radius_;
  std::vector<Group> level_, next_;
};

}  // namespace bch
