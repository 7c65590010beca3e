// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/outline.hpp>

#include "layout/base/plane_point.hpp"

namespace bch::detail {

/// Represents a closed way round a contour, counter-clockwise, by points at even distances. It cuts corners by less than its step.
struct EvenContour {
  std::vector<PlanePoint> points;
  /// Per point, a vector to the left of the way: of length 1 where it is straight, shorter in bends, 0 where it turns back.
  std::vector<PlanePoint> inward;
  double step = 0;  ///< metres of way from a point to the next
};

std::span<const Vec2> longest_contour(const Outline& outline);

/// Makes the way round a contour, its points at most `step` apart.
/// Errors:  throws std::length_error beyond 2^16 points.
EvenContour follow(std::span<const Vec2> contour, double step);

/// Returns which vertices are on an outline.
std::vector<std::uint32_t> vertices_on(const Outline& outline, std::span<const Vec2> vertices);

/// Returns how deep a point lies inside a contour; less than 0 outside.
double depth_in(std::span<const Vec2> contour, const PlanePoint& p);
/// Returns how deep a point lies inside the contour of an outline where it is deepest; less than 0 outside of all.
double depth_in(const Outline& outline, const PlanePoint& p);

/// Represents a point of a contour, and where it is expected on another one.
struct ExpectedPoint {
  PlanePoint position, inward;
};

/// Finds where points that stand round one contour, in order, are on another one: by dynamic time warping, that is, each point of either gets
/// one of the other or more, in order, at the least sum of squared distances; a difference of directions by 1 counts as `turn_cost` metres.
/// Returns: for each point the index of one of the contour's, ascending from the first, and beyond its size once round.
std::vector<std::size_t> match_in_order(std::span<const ExpectedPoint> points, const EvenContour& way,
                                        double turn_cost);

}  // namespace bch::detail
