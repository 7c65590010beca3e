// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <vector>

#include "kernel/obstacles/box_tree.hpp"
#include "kernel/obstacles/distance_grid.hpp"
#include "kernel/obstacles/segment.hpp"

namespace bch::detail {

/// Represents a grid of distances and its memory; it does not move.
struct DistanceGridMemory {
  /// Measures the grid of segments, which are in the order of the tree of their boxes.
  DistanceGridMemory(const BoxTreeView& tree, const std::vector<WorldSegment>& segments);
  DistanceGridMemory(const DistanceGridMemory&) = delete;

  std::vector<std::uint8_t> steps;
  DistanceGridView view;
};

}  // namespace bch::detail
