// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>

#include <bch/geometry.hpp>

#include "layout/outline/grid_geometry.hpp"

namespace bch::detail {

/// Rounds the named vertices, seen from above, to a grid of 2^-23 of the power of two above the largest
/// coordinate: points[i] belongs to vertex used[i], and no coordinate exceeds 2^23. Returns the grid's step in
/// metres, a power of two. So small a grid costs nothing that float had not lost at the largest coordinate, and
/// floats hold every grid point exactly.
/// Preconditions: used is not empty and in increasing order; its values are below positions.size(); points is as long as used.
/// Errors:  throws std::invalid_argument on a coordinate that is not finite or a largest one outside the
///          domain of rounding.hpp.
double snap_to_grid(std::span<const Vec2> positions, std::span<const std::uint32_t> used,
                    std::span<GridPoint> points);
double snap_to_grid(std::span<const Vec3> positions, std::span<const std::uint32_t> used,
                    std::span<GridPoint> points);

}  // namespace bch::detail
