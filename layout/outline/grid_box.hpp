// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "layout/outline/grid_geometry.hpp"

namespace bch::detail {

/// Represents a rectangle on the grid, its sides included.
struct GridBox {
  GridPoint low, high;

  bool contains(GridPoint p) const { return low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y; }
};

/// The empty box. Enlarged by another box it becomes that box.
constexpr GridBox empty_box{
    {std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::max()},
    {std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::min()}};

inline void enlarge(GridBox& box, const GridBox& by) {
  box.low = {std::min(box.low.x, by.low.x), std::min(box.low.y, by.low.y)};
  box.high = {std::max(box.high.x, by.high.x), std::max(box.high.y, by.high.y)};
}

}  // namespace bch::detail
