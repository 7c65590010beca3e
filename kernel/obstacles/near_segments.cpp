// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/obstacles/near_segments.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/runtime/kernels.hpp"

namespace bch::detail {
namespace {

using Vector = ObstaclePlace::Vector;

/// What sums of coordinates may be off by; a box is enlarged by it.
double rounding_of(const ObstaclePlace& place) noexcept {
  return 0x1p-50 * (std::abs(place.x) + std::abs(place.y));
}

LocalSegment local(const ObstaclePlace& place, const WorldSegment& world) noexcept {
  const double way_x = world.bx - world.ax, way_y = world.by - world.ay;
  const double length = std::sqrt(way_x * way_x + way_y * way_y);
  // One without length has any direction.
  const double x = length > 0 ? way_x / length : 1, y = length > 0 ? way_y / length : 0;
  const double dx = world.ax - place.x, dy = world.ay - place.y;
  const auto [along_x, along_y] = place.turned_back(x, y);
  const double from = dx * x + dy * y;
  return {along_x,
          along_y,
          dy * x - dx * y,
          from,
          from + length,
          slack_share * (std::abs(dx) + std::abs(dy) + length),
          0,
          0};
}

}  // namespace

bool crosses(Vector from, Vector way, double square, Vector a, Vector b) noexcept {
  const double ax = a.x - from.x, ay = a.y - from.y, bx = b.x - from.x, by = b.y - from.y;
  const double side_a = way.x * ay - way.y * ax, side_b = way.x * by - way.y * bx;
  if ((side_a > 0) == (side_b > 0)) return false;
  const double along_a = way.x * ax + way.y * ay, along_b = way.x * bx + way.y * by;
  // A mean of both, with weights of one sign.
  const double along = (along_a * side_b - along_b * side_a) / (side_b - side_a);
  return along > 0 && along < square;
}

std::span<const std::uint32_t> NearSegments::query(const BoxTreeView& tree, const Box& box,
                                                   std::vector<std::uint32_t>& slots) {
  constexpr std::size_t least = 64;
  if (slots.size() < least) slots.resize(least);
  for (;;) {
    const std::uint32_t count = implementation_.kernels->find_boxes(tree, box, slots.data(),
                                                                    static_cast<std::uint32_t>(slots.size()));
    if (count <= slots.size()) return {slots.data(), count};
    slots.resize(std::max<std::size_t>(count, 2 * slots.size()));
  }
}

std::span<LocalSegment> NearSegments::find(const ObstaclePlace& place, Vec2 centre, double distance,
                                           Vector way) {
  const auto [x, y] = place.turned(centre.x, centre.y);
  const double wide = distance + rounding_of(place) + 0x1p-50 * (std::abs(way.x) + std::abs(way.y));
  const Box box{place.x + x + std::min(way.x, 0.0) - wide, place.y + y + std::min(way.y, 0.0) - wide,
                place.x + x + std::max(way.x, 0.0) + wide, place.y + y + std::max(way.y, 0.0) + wide};
  found_.clear();
  const bool moves = way.x != 0 || way.y != 0;
  for (const std::uint32_t slot : query(obstacles_.segment_tree, box, slots_)) {
    LocalSegment segment = local(place, obstacles_.segments[slot]);
    if (!moves && !segment.touches(centre.x, centre.y, distance)) continue;
    segment.slot = slot, segment.number = obstacles_.numbers[slot];
    found_.push_back(segment);
  }
  if (found_.size() > 1)
    std::sort(found_.begin(), found_.end(),
              [](const LocalSegment& a, const LocalSegment& b) { return a.number < b.number; });
  return found_;
}

std::span<const std::uint32_t> NearSegments::areas_about(const ObstaclePlace& place, Vec2 point) {
  const auto [x, y] = place.turned(point.x, point.y);
  const double wide = rounding_of(place);
  return query(obstacles_.area_tree,
               {place.x + x - wide, place.y + y - wide, place.x + x + wide, place.y + y + wide}, areas_);
}

bool NearSegments::holds(std::uint32_t area_slot, const ObstaclePlace& place, Vec2 point) {
  const Vector from = place.turned(point.x, point.y);
  const double wide = rounding_of(place), y = place.y + from.y;
  const Box ray{place.x + from.x - wide, y - wide, obstacles_.area_boxes[area_slot].high_x, y + wide};
  bool odd = false;
  for (const std::uint32_t slot : query(obstacles_.segment_tree, ray, slots_)) {
    if (obstacles_.obstacles[obstacles_.numbers[slot]] != obstacles_.areas[area_slot]) continue;
    const auto& [ax, ay, bx, by] = obstacles_.segments[slot];
    odd ^= crosses(from, {1, 0}, std::numeric_limits<double>::infinity(), {ax - place.x, ay - place.y},
                   {bx - place.x, by - place.y});
  }
  return odd;
}

}  // namespace bch::detail
