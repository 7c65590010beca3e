// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>

#include "baselines/placement.hpp"

/// Declares tests of points, segments and triangles whose answers are exact for the doubles that they are
/// given. Sets are closed: touching counts. Triangles may be segments or points, segments may be points.
/// Domain: coordinates are zero or multiples of 2^-301 below 2^100, so that nothing underflows or overflows.
/// Method: signs of orientation determinants, by floating point where its error bound decides, else by exact
/// expansions.
namespace bch::baselines {

struct Point3 {
  double x = 0, y = 0, z = 0;
};

struct Segment2 {
  Point2 a, b;
};
using Triangle2 = std::array<Point2, 3>;
using Triangle3 = std::array<Point3, 3>;

/// Returns 1 if a, b, c turn to the left, -1 if they turn to the right, and 0 if they are collinear.
int orientation(const Point2& a, const Point2& b, const Point2& c) noexcept;

/// Returns 1 if the triangle a, b, c is counter-clockwise as seen from d, -1 if it is clockwise, and 0 if the
/// four are coplanar.
int orientation(const Point3& a, const Point3& b, const Point3& c, const Point3& d) noexcept;

bool segments_meet(const Segment2& s, const Segment2& t) noexcept;

bool triangles_meet(const Triangle2& s, const Triangle2& t) noexcept;

/// Returns whether two triangles in space meet. Source of the common case: P. Guigue, O. Devillers, "Fast and
/// robust triangle-triangle overlap test using orientation predicates", Journal of Graphics Tools 8, 2003.
bool triangles_meet(const Triangle3& s, const Triangle3& t) noexcept;

}  // namespace bch::baselines
