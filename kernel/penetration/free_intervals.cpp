// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/penetration/free_intervals.hpp"

#include <algorithm>
#include <cmath>

namespace bch::detail {
namespace {

using Lanes = FreeLanes<BaseLanes>;
using Float = BaseLanes::Float;
/// Returns what all lanes hold.
float lane_of(Float all) noexcept {
  return BaseLanes::least(all);
}

/// Returns where a sphere touches what its centre is seen from, by a vector.
FreeTouch touch_of_sphere(const Lanes& a, const FreeTouch::Vector& to_centre, float end,
                          float margin) noexcept {
  const auto [x, y, z] = to_centre;
  const float radius = lane_of(a.radius) - margin, length = std::sqrt(x * x + y * y + z * z);
  const FreeTouch::Vector normal{x / length, y / length, z / length};
  return {{lane_of(a.along) - radius * normal.along, lane_of(a.across) - radius * normal.across,
           lane_of(a.z) - radius * normal.up},
          normal,
          end};
}

}  // namespace

template <>
FreeTouch FreeSpheres<BaseLanes>::touch(const Lanes& a, const Lanes& b, float end, float margin) noexcept {
  const float x = lane_of(a.along) + end - lane_of(b.along), y = lane_of(a.across) - lane_of(b.across),
              z = lane_of(a.z) - lane_of(b.z);
  return touch_of_sphere(a, {x, y, z}, end, margin);
}

template <>
FreeTouch FreeWalls<BaseLanes>::touch(const Lanes& a, const Lanes& b, float end, float margin) noexcept {
  const float x = lane_of(a.along) + end - lane_of(b.along), y = lane_of(a.across) - lane_of(b.across),
              z = lane_of(a.z) - lane_of(b.z);
  const float half_x = lane_of(b.half_along), half_y = lane_of(b.half_across), half_z = lane_of(b.half_z);
  const float square = half_x * half_x + half_y * half_y;
  const float part = square > 0 ? std::clamp((x * half_x + y * half_y) / square, -1.0f, 1.0f) : 0;
  return touch_of_sphere(a, {x - part * half_x, y - part * half_y, z - std::clamp(z, -half_z, half_z)}, end,
                         margin);
}

template <>
FreeTouch FreeSegments<BaseLanes>::touch(const Lanes& a, const Lanes& b, float end, float margin) noexcept {
  FreeTouch touch;
  touch.end = end;
  float most = -1;
  const Float m = b.along - a.along - Float(end), w = b.across - a.across;
  // The end of the other segment is at (along, across) from A, and at (m, w) from the middle of the side.
  const auto compare_side = [&](const Lanes& side, Float to_m, Float to_w, Float along, Float across) {
    FreeIntervals<BaseLanes> part;
    part.low = Float(__builtin_inff()), part.high = -part.low;
    add_side(part, side, to_m, to_w, Float(margin));
    const float x = lane_of(side.half_along), y = lane_of(side.half_across),
                length = std::sqrt(x * x + y * y);
    if (!(part.largest(part.high) >= -4 * margin && std::abs(y) > most * length)) return;
    most = std::abs(y) / length;
    touch = {
        {lane_of(along), lane_of(across)}, {most, std::copysign(x / length, x * y > 0 ? -1.0f : 1.0f)}, end};
  };
  for (const Float sign : {Float(-1.0f), Float(1.0f)}) {
    const Float to_b_along = sign * b.half_along, to_b_across = sign * b.half_across;
    compare_side(a, m + to_b_along, w + to_b_across, b.along + to_b_along - Float(end),
                 b.across + to_b_across);
    const Float to_a_along = sign * a.half_along, to_a_across = sign * a.half_across;
    compare_side(b, m - to_a_along, w - to_a_across, a.along + to_a_along, a.across + to_a_across);
  }
  return touch;
}

}  // namespace bch::detail
