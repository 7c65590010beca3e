// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Holds the discs of one cut in the order in which a set stores them: that of cut(), if a ShapeSet was made from the
/// shape. Answers number discs in this order.
struct CutDiscs {
  const float *x, *y, *radius;
  std::uint32_t count;  ///< at least one
};

/// Returns the discs of the cut of `root` = shape * level_count + level. Valid while the set lives.
CutDiscs cut_discs(const ShapeSetView& shapes, std::uint32_t root) noexcept;

/// Returns the radius of a disc about the root's centre that contains all discs of the cut.
inline double outer_radius(const ShapeSetView& shapes, std::uint32_t root) noexcept {
  return double{shapes.trees == nullptr ? shapes.roots[root].radius : shapes.trees[root].outer_radius};
}

/// Returns the position, among a set's nodes, of the first cut disc below a node.
std::uint32_t first_disc(const float* nodes, std::uint32_t node) noexcept;

}  // namespace bch::detail
