// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline_winding.hpp"

#include <algorithm>

namespace bch {
namespace {

/// Whether a point of the stretch's line is between the ends of the stretch.
bool between(const Place& begin, const Place& end, GridPoint point) {
  const GridVector way = begin.direction();
  const bool along_x = way.x != 0;
  const int from_begin = along_x ? compare_x(begin, point.x) : compare_y(begin, point.y);
  const int from_end = along_x ? compare_x(end, point.x) : compare_y(end, point.y);
  const bool forward = along_x ? way.x > 0 : way.y > 0;
  return forward ? from_begin <= 0 && from_end >= 0 : from_begin >= 0 && from_end <= 0;
}

}  // namespace

bool covers(std::span<const Stretch> contour, GridPoint point) {
  int winding = 0;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const Stretch& now = contour[i];
    const Stretch& next = contour[i + 1 < contour.size() ? i + 1 : 0];
    const auto [low, high] = std::minmax(now.rounded_begin.y, next.rounded_begin.y);
    if (point.y < low - 1 || point.y > high + 1) continue;
    const std::int64_t side = cross(now.begin.direction(), point - now.begin.from);
    if (side == 0 && between(now.begin, next.begin, point)) return true;
    const bool begins_above = compare_y(now.begin, point.y) > 0,
               ends_above = compare_y(next.begin, point.y) > 0;
    if (begins_above == ends_above) continue;
    if (ends_above && side > 0) ++winding;
    if (begins_above && side < 0) --winding;
  }
  return winding != 0;
}

}  // namespace bch
