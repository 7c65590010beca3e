// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cmath>

#include "layout/base/plane_point.hpp"
#include "layout/enclosing_disc/disc_sets.hpp"

namespace bch::detail::pivoting {

/// Holds the two or three points on the boundary, and the smallest disc that contains them.
struct Basis {
  PlanePoint points[3];
  int size;
  PlanePoint centre;
  double square_radius;
};

inline Basis basis(PlanePoint a, PlanePoint b) {
  return {{a, b, b}, 2, {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)}, 0.25 * squared_length(a - b)};
}

/// Returns the smallest disc around a triangle: the disc on the longest side as diameter, unless the triangle is
/// acute.
inline Basis basis(PlanePoint a, PlanePoint b, PlanePoint c) {
  const double ab = squared_length(a - b), bc = squared_length(b - c), ca = squared_length(c - a);
  if (ab >= bc + ca) return basis(a, b);
  if (bc >= ab + ca) return basis(b, c);
  if (ca >= ab + bc) return basis(c, a);
  const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
  const double scale = 0.5 / (bx * cy - by * cx);
  const PlanePoint offset{(cy * ab - by * ca) * scale, (bx * ca - cx * ab) * scale};
  return {{a, b, c}, 3, {a.x + offset.x, a.y + offset.y}, offset.x * offset.x + offset.y * offset.y};
}

/// Returns the smallest disc around q, a point outside the old disc, and the points that stay on the boundary: both
/// points of a pair; of three points the one farthest from q, and the one on the other side of the diameter through
/// it.
inline Basis pivot(const Basis& old, PlanePoint q) {
  const auto& p = old.points;
  if (old.size == 2) return basis(q, p[0], p[1]);
  int far = 0;
  for (int i = 1; i < 3; ++i)
    if (squared_length(p[i] - q) > squared_length(p[far] - q)) far = i;
  const int next = far == 2 ? 0 : far + 1, last = far == 0 ? 2 : far - 1;
  const double x = old.centre.x - p[far].x, y = old.centre.y - p[far].y;
  const auto is_left = [&](PlanePoint at) { return x * (at.y - p[far].y) > y * (at.x - p[far].x); };
  return basis(q, p[far], is_left(q) != is_left(p[next]) ? p[next] : p[last]);
}

/// Returns the centre of the smallest enclosing disc of a set. farthest(p) returns the point of the set farthest from
/// p.
/// Source:  J. Elzinga, D. W. Hearn, "Geometrical solutions for some minimax location problems", Transportation
///          Science 6, 1972.
template <class Farthest>
PlanePoint smallest_centre(PlanePoint first, Farthest farthest) {
  const PlanePoint a = farthest(first);
  Basis now = basis(a, farthest(a));
  PlanePoint best = now.centre;
  double least = HUGE_VAL;
  for (int i = 0; i < max_disc_pivots; ++i) {
    const PlanePoint q = farthest(now.centre);
    const double square = squared_length(q - now.centre);
    if (square < least) least = square, best = now.centre;
    if (square <= now.square_radius * disc_slack) break;
    const Basis next = pivot(now, q);
    if (!(next.square_radius > now.square_radius)) break;
    now = next;
  }
  return best;
}

}  // namespace bch::detail::pivoting
