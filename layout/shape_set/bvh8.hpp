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

/// Represents one cut of a hierarchy as a tree of blocks over the cut's discs, together with all nodes above the cut.
/// Every disc is that of the hierarchy's own node, the smallest around the node's primitives. A pair is a hit only if
/// these discs overlap, so larger ones would change answers.
struct Bvh8 {
  /// Holds up to eight groups of the cut's discs in parallel arrays; unused entries are padding.
  ///
  /// - `discs`: the discs of the nodes that are above the groups.
  /// - `child`: a block of this tree, or leaf_bit + the index of the first of eight consecutive discs of the cut.
  ///   These include the whole group and, if it has fewer than eight discs, some of its neighbours. That is harmless,
  ///   because any disc of the cut may be tested at any time.
  /// - `outer_radius`: radii about the same centres that enclose the discs of the groups.
  /// - `node`: an index of `inner_nodes`, or leaf_bit + the index of a disc of the cut.
  struct Block {
    DiscBlock discs;
    std::uint32_t child[block_width];
    float outer_radius[block_width];
    std::uint32_t node[block_width];
  };
  std::vector<Block> blocks;
  std::vector<float> x, y, radius;     ///< the cut's discs in depth-first order, padded to at least eight
  std::vector<InnerNode> inner_nodes;  ///< the nodes above the cut, padded to `count`; links are indices
  std::uint32_t count;                 ///< number of discs of the cut
  std::uint32_t top;                   ///< the root, encoded like Block::child
  Disc root;                           ///< the disc of the hierarchy's root
  float outer_radius;                  ///< the radius about the root's centre that encloses the cut's discs
  bool conservative_nodes;             ///< each node encloses the discs below it (conservative_nodes.hpp)

  bool is_single() const { return count == 1; }
};

/// Collapses the binary tree above a cut. The groups of a block come from its node: the group with the largest
/// product of size and radius is replaced by the groups of its node's children, until there are eight groups or none
/// can be expanded. A group of at most eight discs becomes a leaf block. If the tree would be higher than
/// max_wide_levels, the cut's discs are grouped evenly in their order instead.
Bvh8 bvh8(const Hierarchy& hierarchy, std::uint32_t depth);

/// Builds the trees of several cuts of a hierarchy, one after the other. It reuses memory and allocates nothing once
/// it has processed the largest hierarchy. One thread at a time may use an object.
class Bvh8Builder {
 public:
  /// Takes a hierarchy, which must live until the next begin().
  void begin(const Hierarchy& hierarchy);
  /// Makes a cut the current one and collapses the tree above it.
  void flatten(std::uint32_t depth, Bvh8& tree);
  /// Computes the 32-DOP of the current cut's discs.
  Supports supports() const;
  Outer outer(const Profile& profile) const;

 private:
  /// Represents consecutive discs of the cut, and a node of the hierarchy that is above all of them.
  struct Group {
    std::uint32_t begin, end;  ///< in the list of the cut's discs
    std::uint32_t node;        ///< when grouping by subtrees, it is above no other discs
    std::uint32_t node_end;    ///< the end, in that list, of the discs below the node

    std::uint32_t size() const { return end - begin; }
  };
  static bool is_leaf_block(const Group& group) { return group.size() <= block_width; }
  /// Holds the groups that become one block.
  struct Parts {
    std::array<Group, block_width> group;
    std::array<double, block_width> worth;  ///< of expanding each group; only when grouped by subtrees
    std::uint32_t count = 0;
  };
  /// Represents a node whose discs of the cut, at most `levels_left` levels below it, are still to be collected.
  struct PendingNode {
    std::uint32_t node, levels_left;
  };
  using Split = Parts (Bvh8Builder::*)(const Group&) const;

  void cut(std::uint32_t depth);
  bool grow(Split split, Bvh8& tree);
  std::uint32_t leaf_block(const Group& group) const;
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
  std::vector<std::uint32_t> position_;  ///< per node on or above the cut: its first disc of the cut
  std::vector<std::uint32_t> parent_;    ///< of each node on or above the cut, except the root
  std::vector<std::uint32_t> inner_;     ///< the nodes above the cut
  std::uint32_t count_ = 0;              ///< discs of the cut
  std::vector<float> x_, y_, radius_;
  std::vector<Group> level_, next_;
};

}  // namespace bch::detail
