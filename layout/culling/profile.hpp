// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>

#include <bch/outline.hpp>

#include "layout/culling/interior.hpp"
#include "layout/culling/supports.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Returns the extents of a shape along lines from a centre, sector by sector. One lookup in each of two shapes along
/// the line of their centres, D apart, decides most pairs:
///
///     inner_A + inner_B >= D     a point between the centres belongs to both areas
///     outer_A + outer_B < D      a line across separates the cuts
///     outer_A < D + extent_B     no contour of B lies inside one of A: it sticks out on the far side
///
/// A sector is what has the same place among profile_sectors equal parts of |y| / (|x| + |y|), quadrant by quadrant, and
/// a centre that of the largest contour's area. B looks along the same line from the other end, so its extent is
/// kept with the sector opposite to it.
///
/// Returns: the profile of an outline, both `outer` left at infinity; without an outline, or where it has no room about the
///          centre, `inner` is minus infinity, and so is `extent` of several contours, of which nothing is known.
/// Preconditions: validate(outline) does not throw, or it has no contours; `interior` is that of the outline, `reach`
///          that of the shape, metres.
Profile profile(const Outline& outline, const Interior& interior, double reach);

/// Bounds the support function of one disc or more of a cut, in arrays, about a profile's centre: an upper bound over the directions of
/// each sector.
using Outer = std::array<float, profile_sectors>;
Outer outer(const Profile& profile, const float* x, const float* y, const float* radius, std::uint32_t count,
            double reach);

/// Holds the bounds of a shape about its profile's centre, along directions and by sectors.
struct Bounds {
  Supports supports;
  Outer outer;
};

/// Bounds the points of an outline with contours. `reach` is that of the shape, metres.
Bounds outline_bounds(const Profile& profile, const PointDiscs& points, double reach);

/// Returns how far discs stick out of what smaller bounds hold, metres: with that added, the smaller bounds hold the discs,
/// between two directions as well.
float excess(const Bounds& discs, const Bounds& smaller);

}  // namespace bch::detail
