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

/// Returns the profile of a shape: its extents along lines from a centre, sector by sector. For two shapes whose
/// centres are D apart, one lookup in each profile, along the line of the centres, decides most pairs:
///
///     inner_A + inner_B >= D     a point between the centres belongs to both areas
///     outer_A + outer_B < D      a line across separates the cuts
///     outer_A < D + extent_B     no contour of B lies inside one of A: on the far side of A, B extends beyond A
///
/// A cut is the discs of a level of detail. The centre is the centroid of the largest contour. The profile_sectors
/// sectors are equal parts of |y| / (|x| + |y|), quadrant by quadrant.
///
/// inner and outer are measured from a shape's centre towards the other shape. outer_A of the third line is measured
/// from A's centre towards B. extent_B is measured from B's centre in the same direction, and so away from A. A lookup
/// takes B's sector towards A. So the extent in a sector is that of the directions opposite to the sector's.
///
/// Returns: the profile of an outline, with infinity in Sector::outer (the bound of the deepest cut) and in
///          Sector::shallow_outer (that of coarser cuts), which are set later. `inner` is minus infinity without an
///          outline and in sectors where the centre has no area of the outline around it. `extent` is minus infinity
///          without an outline or with several contours, of which nothing is known.
/// Preconditions: validate(outline) does not throw, or it has no contours; `interior` is that of the outline, `max_extent`
///          that of the shape, metres.
Profile profile(const Outline& outline, const Interior& interior, double max_extent);

/// Holds, per sector, an upper bound of a support function about a profile's centre over the directions of the
/// sector. outer() computes the bounds of one or more discs of a cut.
using Outer = std::array<float, profile_sectors>;
Outer outer(const Profile& profile, const float* x, const float* y, const float* radius, std::uint32_t count,
            double max_extent);

/// Holds the bounds of a shape about its profile's centre, along directions and by sectors.
struct Bounds {
  Supports supports;
  Outer outer;
};

/// Bounds the points of an outline that has contours. `max_extent` is that of the shape, metres.
Bounds outline_bounds(const Profile& profile, const PointDiscs& points, double max_extent);

/// Returns how far discs protrude from smaller bounds, metres. The smaller bounds plus that distance enclose the
/// discs, also between two directions.
float excess(const Bounds& discs, const Bounds& smaller);

}  // namespace bch::detail
