// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <bch/geometry.hpp>

namespace bch::detail {

/// Holds polygons on the ground, metres, as outline_from_polygons() takes them.
using PlanePolygons = std::vector<std::vector<Vec2>>;

/// Describes a body that does not walk by what it covers on the ground: in its own frame, about its position, facing +x.
struct Footprint {
  std::string name;
  PlanePolygons polygons;
};

/// Reads a footprint from well-known text, whose polygons it has; their holes are filled.
/// Errors:  throws std::invalid_argument on what obstacles_from_wkt() and shape_from_polygons() reject, and on lines.
Footprint footprint_from_wkt(const std::string& name, std::string_view text);

/// Returns the footprint of a kind: one of `own`, or a disc, a box, an ellipse, a wheelchair, a bicycle, a trolley or a robot. It is stretched to a
/// length and a width in metres, of which 0 leaves that of the kind; where a disc, a box or an ellipse has one of them, that is the other as well. The
/// polygons of discs and ellipses hold these, and are nowhere farther from them than 1 mm.
/// Errors:  throws std::invalid_argument, naming all kinds, on one that is not known, and on a disc, a box or an ellipse without a size.
PlanePolygons footprint_of(const std::string& kind, double length, double width,
                           std::span<const Footprint> own);

}  // namespace bch::detail
