// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bch/geometry.hpp>

namespace bch {

/// The outline of what a character covers when seen from above: closed contours, counter-clockwise. OutlineBuilder's do
/// not contain each other (holes are left out), and cross themselves by a rounding to the grid at most. A whisker, the
/// trace of a triangle seen edge-on, is a contour (or part of one) that goes there and back.
///
/// Outlines from elsewhere may have contours that touch, cross, overlap or contain themselves or each other. Boundary semantics
/// tests every segment. For solid semantics a point is inside where some contour winds round it an odd number of times.
/// Clockwise contours are refused: they stand for holes, which are to be left out.
struct Outline {
  std::vector<Vec2> points;  ///< metres, in the shape's frame; taken as they are, on a grid or not
  std::vector<std::uint32_t> contour_begin = {0};  ///< contours + 1 offsets into points
  /// The step of the grid that points were rounded to before, metres; 0 if they were not. At most the reach. Discs are
  /// larger by 1.5 of it, so that they hold what was there before the rounding. OutlineBuilder's is a power of two, and its
  /// coordinates are multiples below 2^23, which floats hold exactly.
  float grid_step = 0;

  std::size_t contours() const { return contour_begin.size() - 1; }
  std::span<const Vec2> contour(std::size_t i) const {
    return std::span(points).subspan(contour_begin[i], contour_begin[i + 1] - contour_begin[i]);
  }
};

/// Returns the area inside the contours, square metres; where contours overlap, the sum of theirs.
double area(const Outline& outline);

/// Makes an outline of footprints: polygons on the ground, for bodies that come from no mesh. They are closed from the last corner
/// to the first; the first one repeated at the end, and any corner right behind its equal, counts once. Either way round
/// is fine. They may touch, cross and overlap, as Outline says.
/// Units:   metres, in the shape's frame: the agent's position is (0, 0), and its heading turns the shape about that.
/// Errors:  throws std::invalid_argument, naming the polygon, on none, on one of fewer than three corners or without area, on a
///          corner that is not finite, and on a reach outside 1e-6 to 1e6 m.
Outline outline_from_polygons(std::span<const std::vector<Vec2>> polygons);

/// Checks the promises that hierarchies and shape sets rely on: at least one contour, offsets in order, finite points, reach
/// from 1e-6 to 1e6 m, no clockwise contour (of more area than rounding to the grid explains). All else that
/// Outline allows needs no check.
/// Cost:    linear.
/// Returns: the reach of its points.
/// Errors:  throws std::invalid_argument naming the contour or point and the value.
double validate(const Outline& outline);

}  // namespace bch
