// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernel/obstacles/box_tree.hpp"
#include "layout/base/aligned_vector.hpp"

namespace bch::detail {

/// Represents a tree of boxes and its memory; it does not move.
struct BoxTreeMemory {
  explicit BoxTreeMemory(std::span<const Box> boxes);
  BoxTreeMemory(const BoxTreeMemory&) = delete;

  std::vector<std::uint32_t> order;  ///< the box of each place in the tree
  AlignedVector<BoxBlock> blocks;
  BoxTreeView view;
};

}  // namespace bch::detail
