// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/body/space_frame.hpp"
#include "layout/base/space_point.hpp"
#include "layout/body/sphere_rounding.hpp"

namespace bch::detail {

/// Finds when two spheres that no test of a hit accepts touch, of which A's moves by t v, 0 <= t <= 1. It computes in double, from the
/// floats p, v and r,
///
///     R = r + 2^-19 D,    D = |p|,    h^2 = |p x v|^2,    b = p v
///     t = (D^2 - R^2) / (b + sqrt(R^2 v^2 - h^2)),    T = float(t (1 - 2^-22))
///
/// or 0 where D <= R, and never where b <= 0 or the root is not real.
///
/// Never too late, in the notation of layout/body/sphere_rounding.hpp. Where the tight spheres touch at the true time t, p is off by 9.1 u
/// |b| + 7.6 u |d| + 2 u D; v is rotated as d is and rounded once in z, so t v is off by 5.6 u t |v|, and t |v| <= D + r_A + r_B; |d| <=
/// |a| + |b| + D; and r is off by u (r_A + r_B). In all that is 16.7 u |b| + 7.6 u |a| + 6.6 u (r_A + r_B) + 15.2 u D, of which the first
/// three are at most 16.7 u S, because |a| + r_A <= P_A. Published radii have 30 u S, R adds 32 u D, so that at t the float spheres of
/// radius R overlap, and their first contact is not later. (Spheres that do not move towards each other, b <= 0, where exact ones would:
/// b is off by some u D |v|, so those come nearer by the square of that, and the test of a hit has more to spare.) Double loses 2^-51
/// of the squares that are subtracted, as in kernel/distance/time_of_impact_measure.hpp; R exceeds what touches at t by 16.8 u D, far
/// more than there. The last product takes off 4 u for the rounding to float.
inline double time_of_contact(const SpacePoint& p, const SpacePoint& v, double r) noexcept {
  constexpr double lengthening = 0x1p-19;
  static_assert(lengthening >= (rounding::terms::length_d + 2 + (rounding::terms::position + 1) + 16) *
                                   rounding::unit_roundoff,
                "of D, and as much for what double loses");
  static_assert(rounding::terms::sphere_error >= rounding::terms::length_b + rounding::terms::length_d + 1,
                "of S");
  constexpr double never = std::numeric_limits<double>::infinity();
  const double towards = dot(p, v), square = dot(p, p), radius = r + lengthening * std::sqrt(square);
  const SpacePoint across{p.y * v.z - p.z * v.y, p.z * v.x - p.x * v.z, p.x * v.y - p.y * v.x};
  const double under_root = radius * radius * dot(v, v) - dot(across, across);
  if (!(towards > 0) || !(under_root >= 0)) return never;
  const double left = square - radius * radius;
  return left > 0 ? left / (towards + std::sqrt(under_root)) * (1 - 0x1p-22) : 0;
}

/// Returns a bound of the times of spheres in two cylinders of one frame, of which A's moves by t v: no time of theirs is below it by more
/// than 2^-20 of it. Infinity: they never touch. Times are within the intervals in which the discs and the heights overlap.
///
/// `slack` is 256 u F, where F >= S + |d|. Spheres of a node are within it, and D <= F + S, so that contacts at T are those of cylinders that
/// are enlarged by 32 u D and 30 u S, and by less than 100 u F for what p, v and centres of nodes are rounded. What is left keeps the root
/// away from 0 by far more than double loses.
inline double bound_of_contact(const Cylinder& a, const Cylinder& b, const SpacePoint& v,
                               double slack) noexcept {
  constexpr double never = std::numeric_limits<double>::infinity();
  double from = 0, to = never;
  const double low = b.bottom - a.top - slack, high = b.top - a.bottom + slack;
  if (v.z != 0) {
    const double one = low / v.z, other = high / v.z;
    from = std::max(from, std::min(one, other)), to = std::max(one, other);
  } else if (low > 0 || high < 0) {
    return never;
  }
  const double x = b.x - a.x, y = b.y - a.y, radius = a.radius + b.radius + slack;
  const double left = x * x + y * y - radius * radius, towards = x * v.x + y * v.y,
               across = x * v.y - y * v.x, square = v.x * v.x + v.y * v.y;
  const double under_root = radius * radius * square - across * across;
  if (left > 0) {
    if (!(towards > 0) || !(under_root >= 0)) return never;
    from = std::max(from, left / (towards + std::sqrt(under_root)));
  }
  if (square > 0) to = std::min(to, (towards + std::sqrt(std::max(under_root, 0.0))) / square);
  return from * (1 - 0x1p-20) > to ? never : from;
}

}  // namespace bch::detail
