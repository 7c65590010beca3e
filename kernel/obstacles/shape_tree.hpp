// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Holds the tree of a shape's level, also of a set of single discs, which stores none: a window of the one disc then stands for it.
/// (`Simd` keeps instruction sets from sharing a function.)
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
    for (float& number : window_) number = 0;
    for (unsigned lane = 0; lane < block_width; ++lane) window_[lane] = __builtin_inff();
    window_[0] = only.x, window_[block_width] = only.y, window_[2 * block_width] = only.radius;
    nodes = window_, tree = {leaf_window, 0, block_width, 1, only.radius};
  }
  ShapeTree(const ShapeTree&) = delete;

 private:
  float window_[3 * block_width];
};

}  // namespace bch::detail
