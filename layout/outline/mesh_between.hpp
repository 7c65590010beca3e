// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/geometry.hpp>

namespace bch::detail {

/// Returns what of a mesh lies between two heights, as triangles of their own. Infinite heights cut nothing.
///
/// A cut lies half a float step above the number that names it. So no vertex lies in it, and a point that two meshes share lies on the
/// same side of it in both. A triangle that is cut becomes the fan about a corner of what is left of it. New corners are computed
/// in double from an edge's lower end to its upper one, the same for every triangle at the edge, and then rounded to float.
/// Precondition: triangles name positions.
/// Errors:  throws std::invalid_argument, naming the vertex of a triangle, on a coordinate that is not finite.
std::vector<std::array<Vec3, 3>> mesh_between(std::span<const Vec3> positions,
                                              std::span<const std::array<std::uint32_t, 3>> triangles,
                                              const Heights& heights);

/// Returns the height at which a number cuts: between it and the next float.
double height_of_cut(float number);

}  // namespace bch::detail
