// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Holds a sphere; a disc, whose z is 0; or a segment of an outline or of a wall: the disc about it, half of the way along it, and of a wall
/// half of its height.
struct FreeElement {
  float x, y, z, radius;
  float half_x = 0, half_y = 0, half_z = 0;
};

/// Holds the places along a direction at which elements of A overlap elements of B, in the lanes where they do so anywhere. An element of
/// B is at m along the direction and at w across it, as seen from that of A.
struct FreeIntervals {
  using Simd = BaseLanes;
  using Float = Simd::Float;

  Float low, high;
  Simd::Mask are_some;

  Simd::Mask holding(Float place) const noexcept { return are_some & (low < place) & (place < high); }
  static Float clamped(Float value, Float limit) noexcept {
    return xsimd::min(xsimd::max(value, -limit), limit);
  }
  static float largest(Float values) noexcept { return -Simd::least(-values); }
};

/// Holds elements side by side, as FreeSearch has them.
struct FreeLanes {
  FreeIntervals::Float along, across, z, radius, half_along, half_across, half_z;
  FreeIntervals::Float
      slope;  ///< of a segment: along by across; 0 where it lies along the direction, to the margin
};

/// Holds where A touches an element of B, as seen from A's position, and a unit vector from B to A. Both are along a direction, across it,
/// and up. The interval of the two has that end.
struct FreeTouch {
  struct Vector {
    float along = 0, across = 0, up = 0;
  };
  Vector point, normal = {1, 0, 0};
  float end = -__builtin_inff();
};

/// Spheres, or discs. Let z be how much higher B's is, and r_A what its radius is with the margin:
///
///     R = r_A + r_B,    s = sqrt(R^2 - (w^2 + z^2)),    the two overlap at t  <=>  m - s < t < m + s
///
/// where s is real.
struct FreeSpheres : FreeIntervals {
  FreeSpheres(const FreeLanes& a, const FreeLanes& b, float margin) noexcept;
  /// Returns where two, each in all lanes, touch at the end of their interval.
  static FreeTouch touch(const FreeLanes& a, const FreeLanes& b, float end, float margin) noexcept;
};

/// Segments: what A's has to move by for the two to meet fills a parallelogram about (m, w), whose sides are the segments. The interval is
/// that of its part within the margin of the line across = 0, and a margin longer at both ends. That part ends where its sides do, or
/// where they leave the strip. A side along the line, to the margin, counts as a whole.
struct FreeSegments : FreeIntervals {
  FreeSegments(const FreeLanes& a, const FreeLanes& b, float margin) noexcept;
  /// Returns where two touch: at the side of the parallelogram by which the line leaves it, or of two at a corner the one that is more
  /// across the line.
  static FreeTouch touch(const FreeLanes& a, const FreeLanes& b, float end, float margin) noexcept;
};

/// A sphere, or a disc, and a wall: the sphere's centre is h above or below the wall, so a disc of rho = sqrt(r_A^2 - h^2) must not touch the
/// wall's segment. What A has to move by for that fills a stadium about (m, w): the discs about the segment's ends, and two sides.
struct FreeWalls : FreeIntervals {
  FreeWalls(const FreeLanes& a, const FreeLanes& b, float margin) noexcept;
  static FreeTouch touch(const FreeLanes& a, const FreeLanes& b, float end, float margin) noexcept;
};

/// Widens an interval by the part of a side of a parallelogram that lies in the strip. The middle of the side is at (m, w).
[[gnu::always_inline]] inline void add_side(FreeIntervals& to, const FreeLanes& side, FreeIntervals::Float m,
                                            FreeIntervals::Float w, FreeIntervals::Float margin) noexcept {
  using Simd = FreeIntervals::Simd;
  using Float = FreeIntervals::Float;
  const Float first_w = w - side.half_across, last_w = w + side.half_across;
  const Float first = m - side.half_along + (FreeIntervals::clamped(first_w, margin) - first_w) * side.slope,
              last = m + side.half_along + (FreeIntervals::clamped(last_w, margin) - last_w) * side.slope;
  const auto inside = (xsimd::min(first_w, last_w) <= margin) & (-margin <= xsimd::max(first_w, last_w));
  to.low = Simd::select(inside, xsimd::min(to.low, xsimd::min(first, last)), to.low);
  to.high = Simd::select(inside, xsimd::max(to.high, xsimd::max(first, last)), to.high);
}

[[gnu::always_inline]] inline FreeSpheres::FreeSpheres(const FreeLanes& a, const FreeLanes& b,
                                                       float) noexcept {
  const Float m = b.along - a.along, w = b.across - a.across, z = b.z - a.z, radius = a.radius + b.radius;
  const Float left = radius * radius - (w * w + z * z);
  const Float s = xsimd::sqrt(xsimd::max(left, Float(0.0f)));
  low = m - s, high = m + s, are_some = left > Float(0.0f);
}

[[gnu::always_inline]] inline FreeSegments::FreeSegments(const FreeLanes& a, const FreeLanes& b,
                                                         float by) noexcept {
  const Float m = b.along - a.along, w = b.across - a.across, margin(by);
  low = Float(__builtin_inff()), high = Float(-__builtin_inff()), are_some = Simd::Mask(true);
  add_side(*this, a, m - b.half_along, w - b.half_across, margin);
  add_side(*this, a, m + b.half_along, w + b.half_across, margin);
  add_side(*this, b, m - a.half_along, w - a.half_across, margin);
  add_side(*this, b, m + a.half_along, w + a.half_across, margin);
  low = low - margin, high = high + margin;
}

[[gnu::always_inline]] inline FreeWalls::FreeWalls(const FreeLanes& a, const FreeLanes& b,
                                                   float margin) noexcept {
  const Float none(0.0f), m = b.along - a.along, w = b.across - a.across;
  const Float h = xsimd::max(xsimd::abs(b.z - a.z) - b.half_z, none);
  const Float square = xsimd::max(a.radius * a.radius - h * h, none), rho = xsimd::sqrt(square);
  low = Float(__builtin_inff()), high = Float(-__builtin_inff());
  for (const Float sign : {Float(-1.0f), Float(1.0f)}) {
    const Float end_m = m + sign * b.half_along, end_w = w + sign * b.half_across;
    const Float left = square - end_w * end_w, s = xsimd::sqrt(xsimd::max(left, none));
    low = Simd::select(left > none, xsimd::min(low, end_m - s), low);
    high = Simd::select(left > none, xsimd::max(high, end_m + s), high);
  }
  const Float length = xsimd::sqrt(b.half_along * b.half_along + b.half_across * b.half_across);
  const Float by = Simd::select(length > none, rho / length, none);
  const Float out_m = by * b.half_across, out_w = by * b.half_along;
  add_side(*this, b, m - out_m, w + out_w, Float(margin));
  add_side(*this, b, m + out_m, w - out_w, Float(margin));
  are_some = (square > none) & (low < high);
}

}  // namespace bch::detail
