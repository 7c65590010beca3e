// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "layout/outline.hpp"

namespace bch {

/// The outer boundary of the union of the triangles seen from above. They may be open, non-manifold,
/// duplicated, degenerate; holes are left out. What a triangle contributes as a line (seen edge-on, or
/// thinner than the grid) is kept as a whisker.
///
/// Vertices are snapped to a grid of 2^-23 of the power of two above the reach (0.12 um for a person), and
/// every vertex of a triangle is inside the outline or within 1.5 grid steps of it.
/// Shapes:  triangle indices are below positions.size(); vertices that no triangle uses do not count.
/// Errors:  throws std::invalid_argument on no triangles, an index out of range, a coordinate that is not
///          finite, or a reach outside the domain of rounding.hpp.
Outline union_outline(std::span<const Eigen::Vector3f> positions,
                      std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace bch
