// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/cut_discs.hpp"

#include <bit>
#include <limits>

namespace bch {

/// Children stand in the order of their discs, so the first of the first is the first.
std::uint32_t first_disc(const float* nodes, std::uint32_t top) noexcept {
  while (top < leaf_window) top = std::bit_cast<std::uint32_t>(nodes[top + 3 * block_width]);
  return top & ~leaf_window;
}

CutDiscs cut_discs(const ShapeSetView& shapes, std::uint32_t root) noexcept {
  if (shapes.trees == nullptr) {
    const Root& only = shapes.roots[root];
    return {&only.x, &only.y, &only.radius, 1};
  }
  const auto [top, stride] = shapes.trees[root];
  const float* x = shapes.nodes + first_disc(shapes.nodes, top);
  std::uint32_t count = stride;
  while (count > 1 && x[count - 1] == std::numeric_limits<float>::infinity()) --count;  // padding
  return {x, x + stride, x + 2 * stride, count};
}

}  // namespace bch
