// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <vector>

#include "kernel/obstacles/segment.hpp"

namespace bch::detail {

/// Returns the segments in the order of their numbers, in which those of a path follow each other; as long as the view's arrays live.
inline std::vector<const WorldSegment*> segments_by_number(const ObstacleView& obstacles) {
  std::vector<const WorldSegment*> segments(obstacles.segment_count);
  for (std::uint32_t slot = 0; slot < obstacles.segment_count; ++slot)
    segments[obstacles.segments[slot].number] = &obstacles.segments[slot];
  return segments;
}

}  // namespace bch::detail
