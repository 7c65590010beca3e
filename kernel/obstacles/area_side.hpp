// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <span>

#include "kernel/obstacles/near_segments.hpp"

namespace bch::detail {

/// Tells whether an area holds points that are clear of its segments. The first one is compared with the whole area, and
/// others by the way from there.
class AreaSide {
 public:
  AreaSide(NearSegments& near, const ObstaclePlace& place, std::span<const LocalSegment> segments,
           std::uint32_t obstacle) noexcept
      : near_(near), place_(place), segments_(segments), obstacle_(obstacle) {}

  bool holds(Vec2 point) {
    const ObstaclePlace::Vector at = place_.turned(double{point.x}, double{point.y});
    if (!is_known_) {
      const auto areas = near_.areas_that_hold(place_, point);
      is_known_ = true, first_ = at;
      return first_is_held_ = std::binary_search(areas.begin(), areas.end(), obstacle_);
    }
    const ObstaclePlace::Vector way{at.x - first_.x, at.y - first_.y};
    const double square = way.x * way.x + way.y * way.y;
    bool is_held = first_is_held_;
    for (const LocalSegment& segment : segments_) {
      const WorldSegment& world = near_.obstacles().segments[segment.slot];
      is_held ^= crosses(first_, way, square, {world.ax - place_.x, world.ay - place_.y},
                         {world.bx - place_.x, world.by - place_.y});
    }
    return is_held;
  }

 private:
  NearSegments& near_;
  const ObstaclePlace& place_;
  std::span<const LocalSegment> segments_;
  std::uint32_t obstacle_;
  bool is_known_ = false, first_is_held_ = false;
  ObstaclePlace::Vector first_{};
};

}  // namespace bch::detail
