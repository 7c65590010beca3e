// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <bch/geometry.hpp>

namespace bch::detail {

/// Polygons on the ground, metres, as for outline_from_polygons().
using PlanePolygons = std::vector<std::vector<Vec2>>;

/// Describes a body that does not walk by the ground that it covers, in its own frame: around its position,
/// facing +x.
struct Footprint {
  std::string name;
  PlanePolygons polygons;
};

/// Reads a footprint from polygons in well-known text, without their holes.
/// Errors:  throws std::invalid_argument on what obstacles_from_wkt() and shape_from_polygons() reject, and
///          on lines.
Footprint footprint_from_wkt(const std::string& name, std::string_view text);

/// Returns the footprint of a kind: the name of one of `own`, or disc, box, ellipse, wheelchair, bicycle,
/// trolley or robot. It is stretched to `length` and `width`, metres; 0 keeps the kind's own value, or for a
/// disc, box or ellipse uses the other value. Polygons of discs and ellipses enclose these, by at most 1 mm.
/// Errors:  throws std::invalid_argument on an unknown kind, naming all kinds, and on a disc, box or ellipse
///          without a size.
PlanePolygons footprint_of(const std::string& kind, double length, double width,
                           std::span<const Footprint> own);

}  // namespace bch::detail
