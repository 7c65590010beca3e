// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <span>
#include <vector>

#include "layout/outline/grid_geometry.hpp"

namespace bch::detail {

using GridTriangle = std::array<GridPoint, 3>;

/// Represents a straight piece of the boundary of a union: the union is to its left, nothing is to its right.
struct BoundaryPiece {
  GridPoint begin, end;  ///< rounded to the grid; they differ
  GridVector direction;  ///< of the edge that contains the piece
};

/// Finds the boundary of the union of triangles, by definition: of every edge that has triangles on one side only,
/// the parts whose other side no triangle covers. The ends of these parts are exact fractions of the edge. Each part
/// is found once, even if edges are collinear. Triangles without area are ignored.
std::vector<BoundaryPiece> union_boundary(std::span<const GridTriangle> triangles);

}  // namespace bch::detail
