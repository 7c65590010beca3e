// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/characters.hpp>
#include <bch/geometry.hpp>

namespace bch::detail {

/// Holds the triangles of a skin, halved at their longest edges until edges are short: spheres hold pieces where they are too small for
/// triangles. Points are the vertices, and then the middles of edges.
struct SkinPieces {
  static constexpr std::uint32_t no_child = 0xffffffff;

  /// A triangle or a part of one: halved into two nodes that follow it, or a piece.
  struct Node {
    std::array<std::uint32_t, 3> corners;
    std::array<std::uint32_t, 2> children = {no_child, no_child};
    std::uint32_t piece = no_child;  ///< number among `pieces`, where it is not halved
  };

  std::vector<std::array<std::uint32_t, 2>>
      cuts;                          ///< point vertices + i is the middle of these two earlier ones
  std::vector<Node> nodes;           ///< each triangle's own, each before its children
  std::vector<std::uint32_t> roots;  ///< of triangles
  std::vector<std::array<std::uint32_t, 3>> pieces;  ///< corners

  std::size_t point_count(const Character& character) const {
    return character.vertices.size() + cuts.size();
  }
};

/// Halves the triangles of a character, by its vertices' positions in one pose, until no edge is longer than that, in metres.
SkinPieces cut_skin(const Character& character, std::span<const Vec3> vertices, double longest_edge);

/// Returns the middle of two points, rounded as everywhere: poses have to place a cut's point by the same operations.
constexpr Vec3 middle_of_ends(const Vec3& a, const Vec3& b) {
  return {0.5f * (a.x + b.x), 0.5f * (a.y + b.y), 0.5f * (a.z + b.z)};
}

/// Returns the positions of all points, given those of the vertices: a cut's is the rounded mean of its ends'.
std::vector<Vec3> place_points(std::span<const Vec3> vertices,
                               std::span<const std::array<std::uint32_t, 2>> cuts);

}  // namespace bch::detail
