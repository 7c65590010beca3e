// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/geometry.hpp>

namespace bch::detail {

/// Holds what the connectivity of a mesh determines about its outlines in every pose. Vertices are renumbered: in the
/// same order, but without vertices that no triangle uses.
struct OutlineTopology {
  /// Represents an edge of exactly two triangles that use it in opposite directions. The parallel array
  /// manifold_triangles names these two triangles, because a pose reads them for every edge, but the two vertices for
  /// few edges.
  struct ManifoldEdge {
    std::uint32_t a, b;
  };
  struct EdgeTriangles {
    std::uint32_t first, second;
  };
  /// Represents the use of a non-manifold edge by one triangle.
  struct EdgeUse {
    std::uint32_t a, b;
    std::uint32_t triangle;
    std::int32_t direction;  ///< 1: the triangle's boundary goes from a to b, -1: from b to a
  };

  std::vector<std::uint32_t> used;  ///< per vertex: its index in the mesh
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<ManifoldEdge> manifold;
  std::vector<EdgeTriangles> manifold_triangles;
  std::vector<EdgeUse> uses;              ///< edge after edge
  std::vector<std::uint32_t> uses_begin;  ///< per edge that is not manifold: its first use; and the end
  std::size_t edges_of_uses() const { return uses_begin.size() - 1; }
  std::span<const EdgeUse> uses_of(std::size_t edge) const {
    return std::span(uses).subspan(uses_begin[edge], uses_begin[edge + 1] - uses_begin[edge]);
  }
  std::vector<std::uint32_t> component;         ///< per vertex: the component of the mesh to which it belongs
  std::vector<std::uint32_t> component_vertex;  ///< per component: one of its vertices
};

/// Returns the topology of triangles. Vertices at the same position in the bind pose share edges (a seam of the
/// texture does not separate the skin), and edges that are near each other in the bind pose get near numbers. Neither
/// changes an outline: a pose may separate such vertices. If no bind pose is known, it is empty.
/// Errors:  throws std::invalid_argument if there are no triangles, an index is out of range, the number of positions
///          in the bind pose is neither 0 nor `vertices`, or a position that a triangle uses is not finite.
OutlineTopology outline_topology(std::span<const std::array<std::uint32_t, 3>> triangles,
                                 std::size_t vertices, std::span<const Vec3> bind_pose);

}  // namespace bch::detail
