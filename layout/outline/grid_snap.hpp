// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>

#include <bch/geometry.hpp>

#include "layout/outline/grid_geometry.hpp"

namespace bch::detail {

/// Rounds the vertices `used`, seen from above, to a grid whose step is 2^-23 times the power of two above the
/// largest coordinate. points[i] belongs to vertex used[i], and no coordinate exceeds 2^23 steps, so floats represent
/// every grid point exactly. At the largest coordinate, the step is twice the distance between neighbouring floats.
/// Returns: the grid's step in metres, a power of two.
/// Preconditions: `used` is not empty and ascends; its values are below positions.size(); points.size() ==
///          used.size().
/// Errors:  throws std::invalid_argument if a coordinate is not finite or the largest is outside the domain of
///          rounding.hpp.
double snap_to_grid(std::span<const Vec2> positions, std::span<const std::uint32_t> used,
                    std::span<GridPoint> points);
double snap_to_grid(std::span<const Vec3> positions, std::span<const std::uint32_t> used,
                    std::span<GridPoint> points);

}  // namespace bch::detail
