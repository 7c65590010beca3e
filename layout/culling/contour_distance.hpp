// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <span>

#include "layout/culling/interior_loops.hpp"
#include "layout/culling/tangent_discs.hpp"

namespace bch::detail {

/// Represents a contour's distances from points, and its winding numbers about them.
struct ContourDepths {
  alignas(64) std::array<double, max_touches> distance;
  /// The number of times that the contour goes round the point, counter-clockwise: 1 inside. It has no
  /// meaning on the contour.
  alignas(64) std::array<double, max_touches> winding;
};

/// Measures the depths of the discs' centres, exact except for the rounding of double.
void measure_depths(const InteriorLoops& loops, std::span<const Vec2> contour, const CandidateDiscs& discs,
                    ContourDepths& depths);

/// Computes the discs' depths in float, at half the cost.
void estimate_depths(const InteriorLoops& loops, const ContourPoints& contour, const CandidateDiscs& discs,
                     ContourDepths& depths);

/// Finds the point of a contour nearest to each disc's centre, and the unit vector from there to the centre; both
/// in float, and the vector is 0 for a centre on the contour.
void nearest_touches(const InteriorLoops& loops, const ContourPoints& contour, const CandidateDiscs& discs,
                     Touches& touches);

}  // namespace bch::detail
