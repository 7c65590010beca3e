// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "kernel/obstacles/segment.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Represents an agent and segments of obstacles in that agent's frame.
struct ObstacleArguments {
  const ShapeSetView* shapes;
  std::uint32_t root;  ///< of its level
  const LocalSegment* segments;
  std::uint32_t count;
  bool exact_leaves;  ///< where the tree has segments, these decide
};

constexpr std::uint32_t no_disc = 0xffffffff, no_point = 0xffffffff;

/// Holds the least gap found so far. Of equal gaps, that of the outline's segment with the lowest number is chosen, segments
/// before discs, then of the lowest disc, then of the obstacle's lowest segment.
struct ObstacleGap {
  double gap;  ///< metres
  std::uint32_t
      point;           ///< first point of the outline's segment, in ShapeSetView::points; no_point: of a disc
  std::uint32_t disc;  ///< index in the cut; of an outline 0
  std::uint32_t number;         ///< of the obstacle's segment
  const LocalSegment* segment;  ///< null: none has a gap up to the initial one

  /// Replaces this gap if another comes before it. Returns: whether it does. (Inlined for certain, so that instruction sets share
  /// no function.)
  [[gnu::always_inline]] bool improve(const ObstacleGap& other) noexcept {
    const bool is_first = other.point != point ? other.point < point
                          : other.disc != disc ? other.disc < disc
                                               : other.number < number;
    if (!(other.gap < gap || (other.gap == gap && is_first))) return false;
    *this = other;
    return true;
  }
};

}  // namespace bch::detail
