// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "layout/disc.hpp"

namespace bch {

/// What a character covers when seen from above: closed contours, counter-clockwise, that do not contain each
/// other (holes are left out). A whisker, the trace of a triangle seen edge-on, is a contour (or part of one)
/// that goes there and back. Coordinates are multiples of grid_step and below 2^23 of them, so floats hold
/// them exactly.
struct Outline {
  std::vector<Vec2> points;                        ///< metres, in the shape's frame
  std::vector<std::uint32_t> contour_begin = {0};  ///< contours + 1 offsets into points
  float grid_step = 0;                             ///< metres, a power of two

  std::size_t contours() const { return contour_begin.size() - 1; }
  std::span<const Vec2> contour(std::size_t i) const {
    return std::span(points).subspan(contour_begin[i], contour_begin[i + 1] - contour_begin[i]);
  }
};

/// The largest distance of a point from the origin, at least.
double reach(std::span<const Vec2> points);

/// Area inside the contours, square metres.
double area(const Outline& outline);

/// The contour with the largest area, the first of several.
/// Precondition: there is one.
std::span<const Vec2> largest_contour(const Outline& outline);

/// Checks the promises that hierarchies rely on: at least one contour, offsets in order, finite points, reach
/// within the limits of rounding.hpp.
/// Returns: the reach of its points.
/// Errors:  throws std::invalid_argument naming the contour or point and the value.
double validate(const Outline& outline);

}  // namespace bch
