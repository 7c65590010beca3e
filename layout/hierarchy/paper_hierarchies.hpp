// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <bch/hierarchy.hpp>

namespace bch::detail {

// The hierarchies of the paper other than contour_hierarchy(), which the laboratory and tests compare.

/// Selects the position of the plane that divides a node's segments. The plane's normal is the axis of the larger extent.
enum class SplitRule {
  centroid,  ///< through the centroid, weighted by length so that detailed parts do not pull it
  centre,    ///< through the middle of the extent
};

/// Builds the contour hierarchy by a rule.
/// Errors:  as bch::contour_hierarchy(); also throws std::invalid_argument on an unknown rule.
Hierarchy contour_hierarchy(const Outline& outline, float threshold, SplitRule rule);

/// Builds the paper's hierarchy over all projected triangles. The plane goes through the mean of the vertices, and a
/// triangle goes to the side of its centroid and is never cut. One triangle is a leaf.
/// Returns: the hierarchy with its primitives.
/// Errors:  throws std::invalid_argument on no triangles, an index out of range, a vertex of a triangle that is not finite,
///          or a reach outside 1e-6 to 1e6 m. Vertices of no triangle do not count.
Hierarchy projected_hierarchy(std::span<const Vec2> vertices,
                              std::span<const std::array<std::uint32_t, 3>> triangles);

/// Builds the cylinder of crowd simulators, with one radius for every pose, around the agent's position.
/// Errors:  throws std::invalid_argument unless the radius is from 1e-6 to 1e6 m.
Hierarchy fixed_cylinder(float radius);

/// Returns the height of the tree: the number of edges on the longest path from the root to a leaf.
std::uint32_t height(const Hierarchy& hierarchy);

}  // namespace bch::detail
