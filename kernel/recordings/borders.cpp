// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/borders.hpp"

#include <algorithm>
#include <span>

#include "kernel/obstacles/segments_by_number.hpp"

namespace bch::detail {
namespace {

/// A wall: its segments, in the order of their numbers.
struct Ring {
  std::uint32_t wall;
  std::vector<WorldSegment> segments;
  double left, right, bottom, top;
};

bool is_closed(std::span<const WorldSegment> segments) {
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const WorldSegment &from = segments[i], &to = segments[(i + 1) % segments.size()];
    if (from.bx != to.ax || from.by != to.ay) return false;
  }
  return segments.size() > 2;
}

/// The walls that are lines about something.
std::vector<Ring> rings_of(const ObstacleView& walls) {
  std::vector<std::vector<WorldSegment>> segments(walls.obstacle_count);
  for (const WorldSegment* segment : segments_by_number(walls))
    segments[segment->obstacle].push_back(*segment);
  std::vector<Ring> rings;
  for (std::uint32_t wall = 0; wall < walls.obstacle_count; ++wall) {
    auto& of = segments[wall];
    if (walls.is_area[wall] != 0 || !is_closed(of)) continue;
    Ring ring{wall, std::move(of), 0, 0, 0, 0};
    const auto by_x = [](const WorldSegment& a, const WorldSegment& b) { return a.ax < b.ax; };
    const auto by_y = [](const WorldSegment& a, const WorldSegment& b) { return a.ay < b.ay; };
    const auto [left, right] = std::minmax_element(ring.segments.begin(), ring.segments.end(), by_x);
    const auto [bottom, top] = std::minmax_element(ring.segments.begin(), ring.segments.end(), by_y);
    ring.left = left->ax, ring.right = right->ax, ring.bottom = bottom->ay, ring.top = top->ay;
    rings.push_back(std::move(ring));
  }
  return rings;
}

/// Whether a ring has a point in it, by the even-odd rule.
bool encloses(const Ring& ring, double x, double y) {
  if (x < ring.left || x > ring.right || y < ring.bottom || y > ring.top) return false;
  bool is_inside = false;
  for (const WorldSegment& s : ring.segments)
    if ((s.ay > y) != (s.by > y) && x < s.ax + (s.bx - s.ax) * (y - s.ay) / (s.by - s.ay))
      is_inside = !is_inside;
  return is_inside;
}

}  // namespace

std::vector<std::uint8_t> borders_of(const ObstacleSet& walls) {
  const std::vector<Ring> rings = rings_of(walls.view());
  std::vector<std::uint8_t> borders(std::max(1u, walls.obstacle_count()), 0);
  for (const Ring& ring : rings) {
    const WorldSegment& first = ring.segments[0];
    borders[ring.wall] = std::none_of(rings.begin(), rings.end(), [&](const Ring& other) {
      return other.wall != ring.wall && encloses(other, first.ax, first.ay);
    });
  }
  return borders;
}

}  // namespace bch::detail
