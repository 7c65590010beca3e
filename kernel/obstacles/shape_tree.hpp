// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "kernel/simd/tree_nodes.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Holds a block on the way from the root block to the current one: the lanes that are still unvisited, and their bounds.
struct OpenBlock {
  alignas(64) double bound[block_width];
  std::uint32_t node, lanes;

  /// Returns an unvisited lane, or block_width. (Inlined for certain, so that instruction sets share no function.)
  [[gnu::always_inline]] unsigned first() const noexcept {
    return lanes == 0 ? block_width : static_cast<unsigned>(__builtin_ctz(lanes));
  }
};

/// Holds the tree of a shape's level. Sets of single discs store no trees: then it makes a leaf block of the disc. (`Simd` keeps
/// instruction sets from sharing a function.)
template <class Simd>
struct ShapeTree {
  const float* nodes;
  Tree tree;

  ShapeTree(const ShapeSetView& shapes, std::uint32_t root) noexcept {
    if (shapes.trees != nullptr) {
      nodes = shapes.nodes, tree = shapes.trees[root];
      return;
    }
    const Root& only = shapes.roots[root];
    for (float& number : leaf_block_) number = 0;
    for (unsigned lane = 0; lane < block_width; ++lane) leaf_block_[lane] = __builtin_inff();
    leaf_block_[0] = only.x, leaf_block_[block_width] = only.y, leaf_block_[2 * block_width] = only.radius;
    nodes = leaf_block_, tree = {leaf_bit, 0, block_width, 1, only.radius};
  }
  ShapeTree(const ShapeTree&) = delete;

  /// Walks depth first from the root block, until visit(node, block) returns true. visit() sets the lanes of a block to descend
  /// into, and next(block) returns which of them is next, or block_width. Returns: whether visit() ended the walk.
  template <class Visit, class Next>
  bool walk(const Visit& visit, const Next& next) const {
    OpenBlock open[max_wide_levels + 1];  // the last one for leaf blocks, which set no lanes
    OpenBlock* top = open;
    std::uint32_t node = tree.top;
    for (;;) {
      top->node = node, top->lanes = 0;
      if (visit(node, *top)) return true;
      top += top->lanes != 0;
      unsigned lane = block_width;
      for (; top != open; --top) {
        lane = next(top[-1]);
        if (lane != block_width) break;
      }
      if (top == open) return false;
      top[-1].lanes &= ~(1u << lane);
      node = TreeNodes<Simd>::child(nodes, top[-1].node, lane);
    }
  }

 private:
  float leaf_block_[3 * block_width];
};

}  // namespace bch::detail
