// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/geometry.hpp>

namespace bch::detail {

/// Returns the part of a mesh between two heights, as separate triangles. Infinite heights clip nothing.
///
/// A clipping plane lies half a float step above the given height, so no vertex lies on it, and a point that two
/// meshes share is on the same side in both. The part of a clipped triangle that remains becomes a fan about one of
/// its corners. New corners are computed in double from the lower end of an edge to the upper, in the same way for
/// every triangle at the edge, and then rounded to float.
/// Precondition: triangle indices are below positions.size().
/// Errors:  throws std::invalid_argument, naming the vertex of a triangle, if a coordinate is not finite.
std::vector<std::array<Vec3, 3>> mesh_between(std::span<const Vec3> positions,
                                              std::span<const std::array<std::uint32_t, 3>> triangles,
                                              const Heights& heights);

/// Returns the height of the clipping plane for a given height: between it and the next float.
double height_of_cut(float number);

}  // namespace bch::detail
