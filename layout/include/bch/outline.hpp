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
/// Contours may touch, cross or overlap themselves and each other, and one may contain another; queries test
/// every segment. A point is inside the outline if it is inside any contour, by the even-odd rule applied to
/// that contour alone. Clockwise contours, the holes, occur only with OutlineOptions::holes; hierarchies and
/// sets reject them.
struct Outline {
  std::vector<Vec2> points;                        ///< metres, in the shape's frame; used as given
  std::vector<std::uint32_t> contour_begin = {0};  ///< contours + 1 offsets into points
  /// The step of the grid to which the points were rounded, metres, at most the extent; 0: not rounded.
  /// Discs are enlarged by 1.5 steps, so that they enclose the points before rounding. The step of
  /// OutlineBuilder is a power of two, and coordinates are the step times integers of at most 2^23, which
  /// floats represent exactly.
  float grid_step = 0;

  std::size_t contours() const { return contour_begin.size() - 1; }
  std::span<const Vec2> contour(std::size_t i) const {
    return std::span(points).subspan(contour_begin[i], contour_begin[i + 1] - contour_begin[i]);
  }
};

/// Returns the sum of the signed areas of the contours, square metres.
/// Holes are subtracted, and overlaps count once per contour.
double area(const Outline& outline);

/// Makes an outline of footprints: polygons on the ground, for bodies without a mesh.
/// Polygons may touch, cross and overlap, in either orientation. The last corner is joined to the first; a
/// corner equal to the one before it is ignored.
/// Units:   metres, in the shape's frame, whose origin is the agent's position.
/// Errors:  throws std::invalid_argument if there are no polygons, or if one, which is named, has fewer than
///          three corners, no area, a corner that is not finite, or an extent outside 1e-6 to 1e6 m.
Outline outline_from_polygons(std::span<const std::vector<Vec2>> polygons);

/// Returns an outline as well-known text: a MULTIPOLYGON, which obstacles_from_wkt() also reads.
/// Exteriors are counter-clockwise; a clockwise contour is a hole of the exterior before it. A contour that
/// visits a point twice is split there. Parts without area are left out; an outline without polygons gives
/// MULTIPOLYGON EMPTY. Numbers have the fewest digits that give the same floats.
std::string to_wkt(const Outline& outline);
/// Returns an outline as GeoJSON: a MultiPolygon of RFC 7946 with the polygons of to_wkt().
/// Coordinates are metres, not degrees.
std::string to_geojson(const Outline& outline);

/// Checks what hierarchies and shape sets expect of an outline, in linear time.
/// There is at least one contour, offsets are in order, points are finite, the extent is 1e-6 to 1e6 m, and
/// no contour is clockwise. A negative area is accepted if it is so small that rounding to the grid may have
/// caused it.
/// Returns: the extent of the points.
/// Errors:  throws std::invalid_argument naming the contour or point and the value.
double validate(const Outline& outline);

}  // namespace bch
