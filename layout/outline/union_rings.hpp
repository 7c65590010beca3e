// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>
#include <vector>

#include "layout/outline/union_boundary.hpp"

namespace bch::detail {

using GridRing = std::vector<GridPoint>;

/// Joins the boundary of a union to rings of three corners and more, none of them straight or there twice, that begin at their
/// lexicographically smallest one. Exteriors go counter-clockwise, in the order of where they begin, and each is followed by its
/// holes, which go clockwise.
std::vector<GridRing> rings_of(std::vector<BoundaryPiece> boundary);

}  // namespace bch::detail
