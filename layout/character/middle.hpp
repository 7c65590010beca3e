// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <limits>
#include <span>

#include <bch/geometry.hpp>

namespace bch::detail {

/// Returns the middle of the bounding rectangle of positions, seen from above.
template <class Position>
Vec2 middle_of(std::span<const Position> positions) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  Vec2 low{infinity, infinity}, high{-infinity, -infinity};
  for (const Position& position : positions) {
    low = {std::min(low.x, position.x), std::min(low.y, position.y)};
    high = {std::max(high.x, position.x), std::max(high.y, position.y)};
  }
  return {(low.x + high.x) / 2, (low.y + high.y) / 2};
}

template <class Position>
void move_by(std::span<Position> positions, Vec2 offset) {
  for (Position& position : positions) position.x += offset.x, position.y += offset.y;
}

}  // namespace bch::detail
