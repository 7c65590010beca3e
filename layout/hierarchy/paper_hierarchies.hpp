// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <bch/hierarchy.hpp>

namespace bch::detail {

// The paper's hierarchies other than contour_hierarchy(), for comparison in the laboratory and in tests.

/// Selects the position of the plane that splits a node's segments. Its normal is the axis of the larger extent.
enum class SplitRule {
  centroid,  ///< through the centroid, weighted by length so that detailed parts do not pull it
  centre,    ///< through the middle of the extent
};

/// Builds the contour hierarchy with a split rule.
/// Errors:  as bch::contour_hierarchy(); also throws std::invalid_argument if the rule is invalid.
Hierarchy contour_hierarchy(const Outline& outline, float threshold, SplitRule rule);

/// Builds the paper's hierarchy over all projected triangles. The splitting plane goes through the mean of the
/// vertices. A triangle goes to the side of its centroid and is never cut. A leaf is a single triangle.
/// Returns: the hierarchy with its primitives.
/// Errors:  throws std::invalid_argument if there are no triangles, an index is out of range, a vertex of a triangle
///          is not finite, or the extent is outside 1e-6 to 1e6 m. Vertices without triangles are ignored.
Hierarchy projected_hierarchy(std::span<const Vec2> vertices,
                              std::span<const std::array<std::uint32_t, 3>> triangles);

/// Builds the cylinder of crowd simulators: one radius around the agent's position, the same for every pose.
/// Errors:  throws std::invalid_argument unless the radius is from 1e-6 to 1e6 m.
Hierarchy fixed_cylinder(float radius);

/// Returns the height of the tree: the number of edges on the longest path from the root to a leaf.
std::uint32_t height(const Hierarchy& hierarchy);

}  // namespace bch::detail
