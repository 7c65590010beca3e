// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "layout/format/shape_arrays.hpp"

namespace bch::detail {

/// Holds the windows that a level's nodes name, lane by lane. As signed numbers names of windows are negative, the first the
/// least, and those of blocks are not.
struct NamedWindows {
  static constexpr std::int32_t none = 0;
  std::int32_t least[block_width], most[block_width];
  std::uint32_t count[block_width];
};

/// Holds the places of the nodes of one level of one shape. Checks of a level run in the order of
/// shape_preconditions(); the first ones fill in what the later ones read.
struct LevelNodes {
  std::size_t root;            ///< shape * level count + level
  std::uint64_t begin;         ///< one past the level before
  std::uint64_t discs = 0;     ///< where the cut's discs begin; blocks lie between the tree's top and here
  std::uint64_t end = 0;       ///< one past the level
  std::uint64_t segments = 0;  ///< one past what leaf_segments say of the levels before
  NamedWindows windows{};

  /// Represents an inner node, by its place among them, and the disc of its first child.
  struct OpenNode {
    std::uint32_t node;
    Disc first_child;
  };
  std::vector<OpenNode> open_nodes;  ///< of the check of inner nodes, kept from level to level
};

/// Represents one thing that queries take for granted of the arrays of a set. Each is checked by one function: of the whole set, or
/// of one level after the other.
struct Precondition {
  const char* name;
  const char* says;
  void (*check_set)(const ShapeArrays&);                 ///< throws as validate(); null: see the next
  void (*check_level)(const ShapeArrays&, LevelNodes&);  ///< the same; null: see the one before
};

/// Returns all that validate() checks, in that order: every check may rely on the ones before it.
std::span<const Precondition> shape_preconditions() noexcept;

}  // namespace bch::detail
