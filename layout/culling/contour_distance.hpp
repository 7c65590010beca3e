// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <span>

#include "layout/culling/interior_loops.hpp"
#include "layout/culling/tangent_discs.hpp"

namespace bch::detail {

/// Holds the distances of points from a contour, and the contour's winding numbers about them.
struct ContourDepths {
  alignas(64) std::array<double, max_touches> distance;
  /// How often the contour goes around the point, counter-clockwise: 1 inside. Undefined for points on the contour.
  alignas(64) std::array<double, max_touches> winding;
};

/// Computes distances and winding numbers for the centres of the discs, exact except for the rounding of double.
void measure_depths(const InteriorLoops& loops, std::span<const Vec2> contour, const CandidateDiscs& discs,
                    ContourDepths& depths);

/// Computes the same in float, at half the cost.
void estimate_depths(const InteriorLoops& loops, const ContourPoints& contour, const CandidateDiscs& discs,
                     ContourDepths& depths);

/// Finds, in float, the point of a contour nearest to each disc's centre, and the unit vector from that point to the
/// centre; the vector is 0 for a centre on the contour.
void nearest_touches(const InteriorLoops& loops, const ContourPoints& contour, const CandidateDiscs& discs,
                     Touches& touches);

}  // namespace bch::detail
