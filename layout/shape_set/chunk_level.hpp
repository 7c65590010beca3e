// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "layout/shape_set/animated_tree.hpp"
#include "layout/shape_set/bvh8.hpp"

namespace bch::detail {

/// Holds the discs of a chunk's nodes at a time.
struct PlacedChunk {
  std::vector<float> x, y, radius;      ///< and padding
  std::vector<InnerNode> above_leaves;  ///< the first ones again, without links
};

/// Holds the level of all depths of a chunk, of which time changes nothing but the discs. Its blocks are nodes of the chunk's tree, and
/// each node of the binary tree that halves their children has the disc of the one whose children it holds. These discs hold those below
/// them with room to spare, as those of AnimatedShape::shape() do, and the discs of the cut are the same, bit for bit: every query at this
/// level answers as it does of that shape.
class ChunkLevel {
 public:
  /// Takes a chunk that is not empty, and stays where it is.
  explicit ChunkLevel(const AnimatedTreeChunk& chunk);

  /// Writes the level at a time. `reach`: of the shape, metres. `nodes` is memory.
  void place(const KeyPlace& at, double reach, PlacedChunk& nodes, Bvh8& level) const;

 private:
  /// Represents a node of the binary tree: the node of the chunk whose disc it has, and its link.
  struct Inner {
    std::uint32_t disc, link;
  };
  /// Holds the parts of a block: nodes of the chunk whose discs they have, or the padding behind these, and the other names of Bvh8::Block.
  struct Block {
    std::array<std::uint32_t, block_width> disc{}, child{}, node{};
  };

  std::uint32_t leaves() const noexcept { return chunk_.nodes() - chunk_.first_leaf(); }
  std::uint32_t leaves_before(std::uint32_t node) const noexcept;
  std::uint32_t leaves_to(std::uint32_t node) const noexcept;
  std::uint32_t below_only_children(std::uint32_t node) const noexcept;
  std::uint32_t number(const NodeRange& nodes) const noexcept;
  void add_inner(std::uint32_t node, std::uint32_t above);
  void add_inner(const NodeRange& nodes, std::uint32_t of, std::uint32_t above);
  void add_blocks();
  void place_nodes(const KeyPlace& at, double reach, PlacedChunk& nodes) const;
  void place_inner(const PlacedChunk& nodes, Bvh8& level) const;
  void place_blocks(const PlacedChunk& nodes, Bvh8& level) const;

  const AnimatedTreeChunk& chunk_;
  std::uint32_t root_;
  std::vector<Inner> inner_;
  std::vector<Block> blocks_;
};

}  // namespace bch::detail
