// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "layout/format/shape_arrays.hpp"

namespace bch::detail {

/// Holds, per lane of blocks, the leaf blocks that a level's nodes name. As signed integers, names of leaf blocks are
/// negative, the first of them is the least, and names of blocks are not negative.
struct NamedLeafBlocks {
  static constexpr std::int32_t none = 0;
  std::int32_t least[block_width], most[block_width];
  std::uint32_t count[block_width];
};

/// Holds the positions of the nodes of one level of one shape. The checks of a level run in the order of
/// shape_preconditions(): the first ones fill in what later ones read.
struct LevelNodes {
  std::size_t root;            ///< shape * level count + level
  std::uint64_t begin;         ///< the end of the level before
  std::uint64_t discs = 0;     ///< where the cut's discs begin, after the blocks
  std::uint64_t end = 0;       ///< the end of the level
  std::uint64_t segments = 0;  ///< the end of the leaf_segments of the levels before
  NamedLeafBlocks leaf_blocks{};

  /// Represents a pending inner node, by its index, and the disc of its first child.
  struct OpenNode {
    std::uint32_t node;
    Disc first_child;
  };
  std::vector<OpenNode> open_nodes;  ///< memory of the check of inner nodes, reused for each level
};

/// Describes one assumption of queries about the arrays of a set. One function checks it: for the whole set, or for
/// each level.
struct Precondition {
  const char* name;
  const char* says;
  void (*check_set)(const ShapeArrays&);                 ///< throws as validate(); null if check_level is set
  void (*check_level)(const ShapeArrays&, LevelNodes&);  ///< throws as validate(); null if check_set is set
};

/// Returns all checks of validate(), in order: each may rely on the ones before it.
std::span<const Precondition> shape_preconditions() noexcept;

}  // namespace bch::detail
