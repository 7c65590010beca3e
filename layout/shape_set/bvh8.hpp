// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <bch/hierarchy.hpp>

#include "layout/culling/profile.hpp"
#include "layout/culling/supports.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Represents one cut of a hierarchy as a tree of blocks over the cut's discs, with all nodes above the cut. Every disc is the
/// hierarchy's own, the smallest of what its node holds: pruning by it is part of the answer's definition.
struct Bvh8 {
  /// Holds up to eight groups of cut discs side by side; what is left over is padding. `child`: a block of this tree, or
  /// leaf_window + the index of the first of eight discs, which hold the group and, where it has fewer, some of
  /// its neighbours: harmless, because every disc of the cut may be tested at any time. `outer`: radii about the same
  /// centres that hold the groups' discs. `node`: an index of `inner`, or leaf_window + that of a cut disc.
  struct Block {
    DiscBlock discs;
    std::uint32_t child[block_width];
    float outer_radius[block_width];
    std::uint32_t node[block_width];
  };
  std::vector<Block> blocks;
  std::vector<float> x, y, radius;  ///< the cut in depth-first order; padded to eight where there are fewer
  std::vector<InnerNode> inner_nodes;  ///< as many; links are indices
  std::uint32_t count;                 ///< discs of the cut
  std::uint32_t top;                   ///< as `child`
  Disc root;                           ///< the hierarchy's
  float outer_radius;                  ///< the radius about the root's centre that holds the cut's discs
  bool nodes_hold_discs;               ///< see held_discs.hpp

  bool is_single() const { return count == 1; }
};

/// Collapses the binary tree above a cut: a block's groups come from expanding descendants of its node, those of many
/// and large discs first, until there are eight groups or nothing to expand. What fits into a window becomes one.
/// If that would need more than max_wide_levels, the cut's discs are grouped evenly in their order instead.
Bvh8 bvh8(const Hierarchy& hierarchy, std::uint32_t depth);

/// Builds the trees of several cuts of one hierarchy, one after the other, and reuses its memory. Once it has
/// seen the largest, it allocates nothing. One thread may use it at a time.
class Bvh8Builder {
 public:
  /// Takes a hierarchy, which has to live until the next call.
  void begin(const Hierarchy& hierarchy);
  /// Makes a cut the current one and collapses the tree above it.
  void flatten(std::uint32_t depth, Bvh8& tree);
  /// Computes the 32-DOP of the current cut's discs.
  Supports supports() const;
  Outer outer(const Profile& profile) const;

 private:
  /// Represents a run of the cut's discs, and a node of the hierarchy that is above all of them.
  struct Group {
    std::uint32_t begin, end;  ///< in the list of cut discs
    std::uint32_t node;        ///< with subtree grouping, above no others
    std::uint32_t node_end;    ///< in the list of cut discs, of those below the node

    std::uint32_t size() const { return end - begin; }
  };
  static bool is_window(const Group& group) { return group.size() <= block_width; }
  /// Holds what becomes one block.
  struct Parts {
    std::array<Group, block_width> group;
    std::array<double, block_width> worth;  ///< of expanding each; subtree grouping only
    std::uint32_t count = 0;
  };
  /// Represents a node whose part of the cut is to be found so many levels below, or sooner.
  struct PendingNode {
    std::uint32_t node, levels_left;
  };
  using Split = Parts (Bvh8Builder::*)(const Group&) const;

  void cut(std::uint32_t depth);
  bool grow(Split split, Bvh8& tree);
  std::uint32_t window(const Group& group) const;
  Parts subtrees(const Group& group) const;
  Parts even_runs(const Group& group) const;
  void expand(Parts& parts, std::uint32_t index) const;
  void find_lowest_node(Group& group) const;
  void take_inner(Bvh8& tree) const;
  float outer_radius(const Group& group) const;
  std::uint32_t place(std::uint32_t node) const;
  double worth(const Group& group) const;

  const Hierarchy* hierarchy_ = nullptr;
  std::vector<PendingNode> pending_;
  std::vector<std::uint32_t> position_;  ///< per node on or above the cut: the first of its discs
  std::vector<std::uint32_t> parent_;    ///< per node below another one that is above the cut
  std::vector<std::uint32_t> inner_;     ///< the nodes above the cut
  std::uint32_t count_ = 0;              ///< discs of the cut
  std::vector<float> x_, y_, radius_;
  std::vector<Group> level_, next_;
};

}  // namespace bch::detail
