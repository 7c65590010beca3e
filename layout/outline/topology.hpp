// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/geometry.hpp>

namespace bch::detail {

/// Holds what a mesh's connectivity says about outlines in every pose. Vertices are numbered anew, in the order of
/// their old numbers and without those that no triangle uses.
struct OutlineTopology {
  /// Represents an edge of two triangles that use it in opposite directions, and in a parallel array these triangles: a pose
  /// reads all of the latter and few of the former.
  struct ManifoldEdge {
    std::uint32_t a, b;
  };
  struct EdgeTriangles {
    std::uint32_t first, second;
  };
  /// Represents one triangle's use of any other edge.
  struct EdgeUse {
    std::uint32_t a, b;
    std::uint32_t triangle;
    std::int32_t direction;  ///< 1 or -1: whether the triangle goes round from a to b or from b to a
  };

  std::vector<std::uint32_t> used;  ///< old number of each vertex
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<ManifoldEdge> manifold;
  std::vector<EdgeTriangles> manifold_triangles;
  std::vector<EdgeUse> uses;              ///< edge after edge
  std::vector<std::uint32_t> uses_begin;  ///< of each edge that is not manifold, and the end
  std::size_t edges_of_uses() const { return uses_begin.size() - 1; }
  std::span<const EdgeUse> uses_of(std::size_t edge) const {
    return std::span(uses).subspan(uses_begin[edge], uses_begin[edge + 1] - uses_begin[edge]);
  }
  std::vector<std::uint32_t> island;  ///< of each vertex: parts that share no vertex have different ones
  std::vector<std::uint32_t> island_vertex;  ///< one vertex of each island
};

/// Returns the topology of triangles. Vertices at the same bind position count as the same for the edges (a
/// texture's seam does not separate a skin), and edges are put in an order that keeps neighbours in the bind
/// pose together. What is built does not depend on either: a pose may separate such vertices. An empty bind
/// pose means that nothing is known about it.
/// Errors:  throws std::invalid_argument on no triangles, an index out of range, or a bind pose that has not
///          `vertices` positions or one that is not finite where a triangle uses it.
OutlineTopology outline_topology(std::span<const std::array<std::uint32_t, 3>> triangles,
                                 std::size_t vertices, std::span<const Vec3> bind_pose);

}  // namespace bch::detail
