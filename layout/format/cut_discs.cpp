// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/format/cut_discs.hpp"

#include <bit>
#include <cstddef>

namespace bch::detail {

/// Children stand in the order of their discs, so the first of the first is the first.
std::uint32_t first_disc(const float* nodes, std::uint32_t node) noexcept {
  while (node < leaf_bit) node = std::bit_cast<std::uint32_t>(nodes[node + block_names]);
  return node & ~leaf_bit;
}

CutDiscs cut_discs(const ShapeSetView& shapes, std::uint32_t root) noexcept {
  if (shapes.trees == nullptr) {
    const Root& only = shapes.roots[root];
    return {&only.x, &only.y, &only.radius, 1};
  }
  const Tree& tree = shapes.trees[root];
  const float* x = shapes.nodes + tree.discs;
  return {x, x + tree.stride, x + 2 * std::size_t{tree.stride}, tree.count};
}

}  // namespace bch::detail
