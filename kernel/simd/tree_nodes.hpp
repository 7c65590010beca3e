// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "kernel/simd/disc_pairs.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Decodes the name of a node of a flat tree (layout/format/shape_set_view.hpp): its index in ShapeSetView::nodes,
/// with the top bit set for a leaf block. A leaf block is a leaf of eight consecutive discs of the cut (the discs of
/// one level of detail). All other nodes are blocks. (`Simd` keeps instruction sets from sharing a function.)
template <class Simd>
struct TreeNodes {
  /// Returns a mask, all ones if the node is a leaf block. GCC would compile a condition to a branch, and no processor
  /// can predict which nodes are leaf blocks.
  static std::uint32_t all_if_leaf(std::uint32_t node) noexcept { return -(node / leaf_bit); }

  /// Returns the eight discs of a node. In a leaf block, an x, its y and its radius are `stride` floats apart
  /// (Tree::stride); in a block they are block_width floats apart.
  static Discs discs(const float* nodes, std::uint32_t node, std::uint32_t stride) noexcept {
    const std::size_t to_y = block_width + (all_if_leaf(node) & (stride - block_width));
    return {nodes + (node & ~leaf_bit), to_y, 2 * to_y};
  }

  /// Returns the eight discs of a node, for distances. The discs of a block have their outer radii: a disc of the same
  /// centre with the outer radius encloses all discs of the cut below, which may protrude from the disc itself.
  static Discs outer_discs(const float* nodes, std::uint32_t node, std::uint32_t stride) noexcept {
    const std::uint32_t leaf = all_if_leaf(node);
    return {nodes + (node & ~leaf_bit), block_width + (leaf & (stride - block_width)),
            block_outer + (leaf & (2 * stride - block_outer))};
  }

  /// Prefetches a node's discs, and the names of a block's children. (Here and elsewhere inlined for certain: GCC 12
  /// drops the calls of functions that do nothing else.)
  [[gnu::always_inline]] static void prefetch(const float* nodes, std::uint32_t node,
                                              std::uint32_t stride) noexcept {
    const Discs at = discs(nodes, node, stride);
    for (std::size_t row = 0; row < 3; ++row) __builtin_prefetch(at.x + row * at.to_y);
  }

  /// Returns the name of the child below a disc of a block.
  static std::uint32_t child(const float* nodes, std::uint32_t block, unsigned lane) noexcept {
    std::uint32_t name;
    __builtin_memcpy(&name, nodes + block + block_names + lane, sizeof name);
    return name;
  }
};

}  // namespace bch::detail
