// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "tests/support/standard.hpp"

// Distances in the plane, as textbooks have them, in any floating-point type.

namespace bch::test {

/// Returns the distance of a point (x, y) from the segment between a and b.
template <class Real>
Real distance_to_segment(Real x, Real y, Real ax, Real ay, Real bx, Real by) {
  const Real dx = bx - ax, dy = by - ay, square = dx * dx + dy * dy;
  const Real fraction =
      square > 0 ? std::clamp(((x - ax) * dx + (y - ay) * dy) / square, Real(0), Real(1)) : Real(0);
  return std::hypot(x - ax - fraction * dx, y - ay - fraction * dy);
}

/// Returns the distance of a point from a contour, negative outside of it by the even-odd rule.
template <class Real>
Real depth_in_contour(std::span<const Vec2> contour, Real x, Real y) {
  Real nearest = std::numeric_limits<Real>::infinity();
  bool inside = false;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const Vec2 a = contour[i], b = contour[(i + 1) % contour.size()];
    const Real ax = a.x, ay = a.y, bx = b.x, by = b.y;
    nearest = std::min(nearest, distance_to_segment(x, y, ax, ay, bx, by));
    if ((ay > y) != (by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax)) inside = !inside;
  }
  return inside ? nearest : -nearest;
}

}  // namespace bch::test
