// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Holds the discs of one cut, in the order in which a set stores them: that of cut() for what a ShapeSet was made from. This
/// is what numbers a disc in an answer.
struct CutDiscs {
  const float *x, *y, *radius;
  std::uint32_t count;  ///< at least one
};

/// Returns the discs of a cut, of `root` = shape * level_count + level. Valid while the set lives.
CutDiscs cut_discs(const ShapeSetView& shapes, std::uint32_t root) noexcept;

/// Returns where, among a set's nodes, the first cut disc below a node stands.
std::uint32_t first_disc(const float* nodes, std::uint32_t node) noexcept;

}  // namespace bch::detail
