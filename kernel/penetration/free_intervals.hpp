// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Holds the places along a direction at which elements of A overlap elements of B, in the lanes where they do so anywhere. An element of
/// B is at m along the direction and at w across it, as seen from that of A.
template <class Simd>
struct FreeIntervals {
  using Float = typename Simd::Float;

  using Mask = typename Simd::Mask;

  Float low, high;
  Mask are_some;

  Mask holding(Float place) const noexcept { return are_some & (low < place) & (place < high); }
  static Float clamped(Float value, Float limit) noexcept {
    return xsimd::min(xsimd::max(value, -limit), limit);
  }
  static float largest(Float values) noexcept { return -Simd::least(-values); }
};

/// Holds elements side by side, as FreeKernel has them.
template <class Simd>
struct FreeLanes {
  typename Simd::Float along, across, z, radius, half_along, half_across, half_z;
  /// Of a segment: along by across; 0 where it lies along the direction, to the margin.
  typename Simd::Float slope;
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
template <class Simd>
struct FreeSpheres : FreeIntervals<Simd> {
  using typename FreeIntervals<Simd>::Float, typename FreeIntervals<Simd>::Mask;
  using Lanes = FreeLanes<Simd>;
  FreeSpheres(const Lanes& a, const Lanes& b, float margin) noexcept;
  /// Returns where intervals may hold a place. The slack is that of nodes.
  static Mask may_hold(const Lanes& a, const Lanes& b, float place, float margin, float slack) noexcept;
  /// Returns where two, each in all lanes, touch at the end of their interval.
  static FreeTouch touch(const Lanes& a, const Lanes& b, float end, float margin) noexcept;
};

/// Segments: what A's has to move by for the two to meet fills a parallelogram about (m, w), whose sides are the segments. The interval is
/// that of its part within the margin of the line across = 0, and a margin longer at both ends. That part ends where its sides do, or
/// where they leave the strip. A side along the line, to the margin, counts as a whole.
template <class Simd>
struct FreeSegments : FreeIntervals<Simd> {
  using typename FreeIntervals<Simd>::Float, typename FreeIntervals<Simd>::Mask;
  using Lanes = FreeLanes<Simd>;
  FreeSegments(const Lanes& a, const Lanes& b, float margin) noexcept;
  /// Returns where intervals may hold a place. The slack is that of nodes.
  static Mask may_hold(const Lanes& a, const Lanes& b, float place, float margin, float slack) noexcept;
  /// Returns where two touch: at the side of the parallelogram by which the line leaves it, or of two at a corner the one that is more
  /// across the line.
  static FreeTouch touch(const Lanes& a, const Lanes& b, float end, float margin) noexcept;
};

/// A sphere, or a disc, and a wall: the sphere's centre is h above or below the wall, so a disc of rho = sqrt(r_A^2 - h^2) must not touch the
/// wall's segment. What A has to move by for that fills a stadium about (m, w): the discs about the segment's ends, and two sides.
template <class Simd>
struct FreeWalls : FreeIntervals<Simd> {
  using typename FreeIntervals<Simd>::Float, typename FreeIntervals<Simd>::Mask;
  using Lanes = FreeLanes<Simd>;
  FreeWalls(const Lanes& a, const Lanes& b, float margin) noexcept;
  /// Returns where intervals may hold a place. The slack is that of nodes.
  static Mask may_hold(const Lanes& a, const Lanes& b, float place, float margin, float slack) noexcept;
  static FreeTouch touch(const Lanes& a, const Lanes& b, float end, float margin) noexcept;
};

/// Widens an interval by the part of a side of a parallelogram that lies in the strip. The middle of the side is at (m, w).
template <class Simd, class Float = typename Simd::Float>
[[gnu::always_inline]] inline void add_side(FreeIntervals<Simd>& to, const FreeLanes<Simd>& side, Float m,
                                            Float w, Float margin) noexcept {
  const Float first_w = w - side.half_across, last_w = w + side.half_across;
  const Float first = m - side.half_along +
                      (FreeIntervals<Simd>::clamped(first_w, margin) - first_w) * side.slope,
              last =
                  m + side.half_along + (FreeIntervals<Simd>::clamped(last_w, margin) - last_w) * side.slope;
  const auto inside = (xsimd::min(first_w, last_w) <= margin) & (-margin <= xsimd::max(first_w, last_w));
  to.low = Simd::select(inside, xsimd::min(to.low, xsimd::min(first, last)), to.low);
  to.high = Simd::select(inside, xsimd::max(to.high, xsimd::max(first, last)), to.high);
}

template <class Simd>
[[gnu::always_inline]] inline FreeSpheres<Simd>::FreeSpheres(const Lanes& a, const Lanes& b, float) noexcept {
  const Float m = b.along - a.along, w = b.across - a.across, z = b.z - a.z, radius = a.radius + b.radius;
  const Float left = radius * radius - (w * w + z * z);
  const Float s = xsimd::sqrt(xsimd::max(left, Float(0.0f)));
  this->low = m - s, this->high = m + s, this->are_some = left > Float(0.0f);
}

template <class Simd>
[[gnu::always_inline]] inline FreeSegments<Simd>::FreeSegments(const Lanes& a, const Lanes& b,
                                                               float by) noexcept {
  const Float m = b.along - a.along, w = b.across - a.across, margin(by);
  this->low = Float(__builtin_inff()), this->high = Float(-__builtin_inff());
  this->are_some = typename Simd::Mask(true);
  add_side(*this, a, m - b.half_along, w - b.half_across, margin);
  add_side(*this, a, m + b.half_along, w + b.half_across, margin);
  add_side(*this, b, m - a.half_along, w - a.half_across, margin);
  add_side(*this, b, m + a.half_along, w + a.half_across, margin);
  this->low = this->low - margin, this->high = this->high + margin;
}

template <class Simd>
[[gnu::always_inline]] inline FreeWalls<Simd>::FreeWalls(const Lanes& a, const Lanes& b,
                                                         float margin) noexcept {
  const Float none(0.0f), m = b.along - a.along, w = b.across - a.across;
  const Float h = xsimd::max(xsimd::abs(b.z - a.z) - b.half_z, none);
  const Float square = xsimd::max(a.radius * a.radius - h * h, none), rho = xsimd::sqrt(square);
  Float low(__builtin_inff()), high(-__builtin_inff());
  const Float signs[] = {Float(-1.0f), Float(1.0f)};
  for (const Float sign : signs) {
    const Float end_m = m + sign * b.half_along, end_w = w + sign * b.half_across;
    const Float left = square - end_w * end_w, s = xsimd::sqrt(xsimd::max(left, none));
    low = Simd::select(left > none, xsimd::min(low, end_m - s), low);
    high = Simd::select(left > none, xsimd::max(high, end_m + s), high);
  }
  const Float length = xsimd::sqrt(b.half_along * b.half_along + b.half_across * b.half_across);
  this->low = low, this->high = high;
  const Float by = Simd::select(length > none, rho / length, none);
  const Float out_m = by * b.half_across, out_w = by * b.half_along;
  add_side(*this, b, m - out_m, w + out_w, Float(margin));
  add_side(*this, b, m + out_m, w - out_w, Float(margin));
  this->are_some = (square > none) & (this->low < this->high);
}

template <class Simd>
[[gnu::always_inline]] inline auto FreeSpheres<Simd>::may_hold(const Lanes& a, const Lanes& b, float place,
                                                               float, float slack) noexcept -> Mask {
  const Float m = b.along - a.along - Float(place), w = b.across - a.across, z = b.z - a.z,
              radius = a.radius + b.radius + Float(slack);
  return m * m + w * w + z * z <= radius * radius;
}

template <class Simd>
[[gnu::always_inline]] inline auto FreeWalls<Simd>::may_hold(const Lanes& a, const Lanes& b, float place,
                                                             float, float slack) noexcept -> Mask {
  const Float m = b.along - a.along - Float(place), w = b.across - a.across,
              radius = a.radius + b.radius + Float(slack);
  return m * m + w * w <= radius * radius;
}

/// A place in an interval is near the parallelogram: along the line, the interval is a margin longer at both ends; across it, a side that
/// counts as a whole leaves the strip by up to two margins more. So it is within four margins, and the slack is room for rounding. A point of
/// the parallelogram is no farther from the middle line of two sides than these are, and all is multiplied by the length of half a side.
template <class Simd>
[[gnu::always_inline]] inline auto FreeSegments<Simd>::may_hold(const Lanes& a, const Lanes& b, float place,
                                                                float margin, float slack) noexcept -> Mask {
  const Float m = b.along - a.along - Float(place), w = b.across - a.across, near(4 * margin + slack);
  const Float area = xsimd::abs(a.half_along * b.half_across - a.half_across * b.half_along);
  return (xsimd::abs(m * a.half_across - w * a.half_along) <= area + a.radius * near) &
         (xsimd::abs(m * b.half_across - w * b.half_along) <= area + b.radius * near);
}

}  // namespace bch::detail
