// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>
#include <vector>

#include "layout/outline/union_boundary.hpp"

namespace bch::detail {

using GridRing = std::vector<GridPoint>;

/// Joins the boundary of a union to rings. A ring has at least three corners, none of them straight or repeated, and
/// begins at its lexicographically smallest corner. Exteriors are counter-clockwise, in the order of their first
/// corners; the clockwise holes of an exterior follow it.
std::vector<GridRing> rings_of(std::vector<BoundaryPiece> boundary);

}  // namespace bch::detail
