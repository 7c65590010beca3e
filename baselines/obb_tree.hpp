// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/geometry.hpp>
#include <bch/outline.hpp>

namespace bch::baselines {

/// Represents what a tree of oriented boxes holds: a triangle, or a segment (c equals b).
using Facet = std::array<Eigen::Vector3f, 3>;

/// Represents an oriented box in its shape's frame, one cache line. A tree's nodes stand in depth-first
/// order: the first child of an inner node is the next node.
///
/// The box holds the points p with |axis[k] . (p - centre)| <= half[k], for the stored axes, whose rounding
/// leaves them orthonormal up to 2^-24. `half` is larger than what its facets need by box_margin of the
/// shape's extent, so that the float test in obb_overlap.hpp never misses.
struct ObbNode {
  static constexpr std::uint32_t leaf_bit = 0x80000000;

  float axis[3][3];
  float centre[3];
  float half[3];       ///< descending
  std::uint32_t link;  ///< second child; of a leaf, its facet with leaf_bit set

  bool is_leaf() const noexcept { return (link & leaf_bit) != 0; }
  std::uint32_t facet() const noexcept { return link & ~leaf_bit; }
};
static_assert(sizeof(ObbNode) == 64);

/// Represents a tree of oriented boxes after S. Gottschalk, M. C. Lin, D. Manocha, "OBBTree: a hierarchical
/// structure for rapid interference detection", SIGGRAPH 1996.
/// Boxes: aligned with the eigenvectors of the covariance of the facets' area (of segments: their length).
///        The paper prefers the area of the facets' convex hull, which interior facets cannot tilt; a walking
///        person's surface is nearly its hull at the scales where boxes are large, and deeper down patches
///        have no interior. Moments cost O(n) a level and no hull code. A lone facet gets its own tightest
///        frame: longest edge, normal.
/// Split: at the mean of the facets along the longest axis of the box, by the facets' centroids; where one
///        side would stay empty, along the next axis; then in halves by count. Leaves hold one facet.
struct ObbTree {
  std::vector<ObbNode> nodes;
  std::vector<Facet> facets;  ///< in the order of the leaves
  std::uint32_t height = 0;   ///< edges on the longest path from the root to a leaf

  std::size_t bytes() const { return nodes.size() * sizeof(ObbNode) + facets.size() * sizeof(Facet); }
};

/// Builds a tree over facets. Errors: throws std::invalid_argument on no facets, a coordinate that is not
/// finite, an extent (distance from the origin, in space) outside the limits of rounding.hpp; std::length_error
/// beyond 2^22 facets.
ObbTree build_obb_tree(std::vector<Facet> facets);

/// Return the facets of triangles, in space and as they are seen from above. Errors: throw std::invalid_argument on no
/// triangles or an index out of range.
std::vector<Facet> triangle_facets(std::span<const Vec3> positions,
                                   std::span<const std::array<std::uint32_t, 3>> triangles);
std::vector<Facet> projected_facets(std::span<const Vec3> positions,
                                    std::span<const std::array<std::uint32_t, 3>> triangles);
/// Returns the segments of an outline. Errors: throws std::invalid_argument on an outline that validate() rejects.
std::vector<Facet> contour_facets(const Outline& outline);

/// The margin of half-extents, times the shape's extent; derived in obb_overlap.hpp.
constexpr double box_margin = 0x1p-17;

}  // namespace bch::baselines
