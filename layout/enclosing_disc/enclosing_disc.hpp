// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>

#include <bch/geometry.hpp>

namespace bch::detail {

/// Represents the smallest disc around points. The centre is rounded to float, as it will be stored. The radius is
/// that around the rounded centre and is exact except for the rounding of double.
struct EnclosingDisc {
  Vec2 centre;
  double radius = 0;
};

/// Returns the smallest disc that contains points, up to the rounding of its centre to float: every point is within
/// `radius` of `centre`.
/// Shapes:  at least one point; any order, duplicates and collinear points allowed.
/// Source:  see disc_pivoting.hpp; for many sets at once, see enclosing_discs.hpp.
EnclosingDisc smallest_enclosing_disc(std::span<const Vec2> points);

}  // namespace bch::detail
