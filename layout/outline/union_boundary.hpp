// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <span>
#include <vector>

#include "layout/outline/grid_geometry.hpp"

namespace bch::detail {

using GridTriangle = std::array<GridPoint, 3>;

/// Represents a straight piece of the boundary of a union: the union is to its left, and nothing is to its right.
struct BoundaryPiece {
  GridPoint begin, end;  ///< rounded, and not the same
  GridVector direction;  ///< of the edge that it is a piece of
};

/// Finds the boundary of the union of triangles, by definition: of every edge that has its triangles on one side, the parts whose other
/// side no triangle covers. Exact fractions of the edge bound these parts; each is found once, also where edges lie on one
/// line. Triangles without area do not count.
std::vector<BoundaryPiece> union_boundary(std::span<const GridTriangle> triangles);

}  // namespace bch::detail
