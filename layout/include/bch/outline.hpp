// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <bch/geometry.hpp>

namespace bch {

/// Holds the outline of what a character covers when seen from above: closed contours, counter-clockwise.
/// Contours may touch, cross, overlap or contain themselves or each other; every segment counts. A point is
/// inside if the even-odd rule of any one contour says so. Only OutlineOptions::holes adds clockwise
/// contours, the holes; hierarchies and sets reject them. "Outlines" in layout/README.md says what
/// OutlineBuilder makes.
struct Outline {
  std::vector<Vec2> points;  ///< metres, in the shape's frame; taken as they are, on a grid or not
  std::vector<std::uint32_t> contour_begin = {0};  ///< contours + 1 offsets into points
  /// Gives the step of the grid to which points were rounded before, metres; 0 if they were not.
  /// It is at most the reach. Discs are enlarged by 1.5 steps, so that they enclose the points as they were
  /// before. The step of OutlineBuilder is a power of two, and coordinates are multiples below 2^23, which
  /// floats hold exactly.
  float grid_step = 0;

  std::size_t contours() const { return contour_begin.size() - 1; }
  std::span<const Vec2> contour(std::size_t i) const {
    return std::span(points).subspan(contour_begin[i], contour_begin[i + 1] - contour_begin[i]);
  }
};

/// Returns the sum of the contours' signed areas, square metres: holes are subtracted, and overlaps count
/// repeatedly.
double area(const Outline& outline);

/// Makes an outline of footprints: polygons on the ground, for bodies that come from no mesh.
/// Polygons may touch, cross and overlap, in either orientation. The last corner is joined to the first; a
/// corner equal to the one before it does not count.
/// Units:   metres, in the shape's frame: the agent's position is (0, 0), and its heading turns the shape
///          about that.
/// Errors:  throws std::invalid_argument, naming the polygon, on no polygons, on one of fewer than three
///          corners or without area, on a corner that is not finite, and on a reach outside 1e-6 to 1e6 m.
Outline outline_from_polygons(std::span<const std::vector<Vec2>> polygons);

/// Returns an outline as well-known text: a MULTIPOLYGON, which obstacles_from_wkt() reads as well.
/// Exteriors go counter-clockwise, and a clockwise contour is a hole of the exterior before it. No ring
/// visits a point twice: contours are split there. Parts without area, such as whiskers, are left out; an
/// outline without polygons gives MULTIPOLYGON EMPTY. Numbers are the floats' shortest text.
std::string to_wkt(const Outline& outline);
/// Returns an outline as GeoJSON: a MultiPolygon of RFC 7946.
/// The polygons are those of to_wkt(), in metres instead of degrees.
std::string to_geojson(const Outline& outline);

/// Checks the promises that hierarchies and shape sets rely on.
/// They are at least one contour, offsets in order, finite points, a reach from 1e-6 to 1e6 m, and no
/// clockwise contour (of more area than rounding to the grid explains). Takes linear time.
/// Returns: the reach of its points.
/// Errors:  throws std::invalid_argument naming the contour or point and the value.
double validate(const Outline& outline);

}  // namespace bch
