// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "kernel/obstacles/segment.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// A part of an agent and segments of obstacles in that agent's frame.
struct ObstacleArguments {
  const ShapeSetView* shapes;
  std::uint32_t root;  ///< of the part's level
  const LocalSegment* segments;
  std::uint32_t count;
  bool exact_leaves;  ///< where the tree has segments, these decide
};

/// The smallest gap found so far. An equal gap replaces it if its disc, then its segment, has a lower number.
struct ObstacleGap {
  double gap;                   ///< metres
  std::uint32_t disc;           ///< of the part's cut
  std::uint32_t number;         ///< of the segment
  const LocalSegment* segment;  ///< null: there is none up to the gap that stood here
};

constexpr std::uint32_t no_disc = 0xffffffff;

}  // namespace bch::detail
