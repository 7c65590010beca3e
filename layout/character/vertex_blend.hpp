// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <bch/character.hpp>
#include <bch/geometry.hpp>
#include <bch/pose_shape.hpp>

#include "layout/base/aligned_vector.hpp"

namespace bch::detail {

/// Holds the share of a bone in the place of a point, and where the point is in that bone's frame.
struct PointInfluence {
  std::uint32_t bone;
  float weight;
  Vec3 at;
};

/// Returns those of a character's vertices: as many, in the same order, as Character::influences.
std::vector<PointInfluence> influences_of(const Character& character);

/// Represents the place of a point of space, in a register.
struct alignas(16) SpaceRow {
  float x, y, z, unused;
};

/// Represents a mesh that its bones move: each vertex goes to the mean of where they take it, weighted. What does not depend
/// on the pose is done once: a vertex is multiplied by its weights, so that every bone adds one product, and
/// vertices of equally many bones stand together, so that how many is no surprise.
class VertexBlend {
 public:
  /// Represents one of a map's three, or a vertex and 1.
  struct alignas(16) Row {
    float at[4];
  };

  /// Takes the vertices of a character.
  explicit VertexBlend(const Character& character);
  /// Takes points: point i has influences begin[i] to begin[i + 1].
  VertexBlend(std::span<const std::uint32_t> begin, std::span<const PointInfluence> influences);

  /// Returns the bones that move a vertex, in order.
  std::span<const std::uint32_t> bones() const { return bones_; }

  /// Writes where every vertex goes. maps[i] is that of bones()[i].
  /// Returns: the first vertex whose position is not finite, if there is one.
  std::optional<std::uint32_t> blend(std::span<const Affine3d> maps, std::span<Vec3> positions);
  /// Writes the same bits a register each.
  std::optional<std::uint32_t> blend(std::span<const Affine3d> maps, std::span<SpaceRow> positions);
  /// Writes x and y alone, with the same bits, for views from above.
  std::optional<std::uint32_t> blend(std::span<const Affine3d> maps, std::span<Vec2> positions);

 private:
  /// Holds vertices that so many bones move, up to `end` of the order.
  struct Run {
    std::uint32_t bones, end;
  };

  template <class Position>
  std::optional<std::uint32_t> blend_all(std::span<const Affine3d> maps, std::span<Position> positions);

  std::vector<std::uint32_t> bones_;
  std::vector<Run> runs_;
  std::vector<std::uint32_t> vertex_;     ///< in the order of work
  AlignedVector<Row> weighted_;           ///< per influence: the vertex and 1, times the weight
  std::vector<std::uint32_t> first_row_;  ///< per influence: of its bone's three
  AlignedVector<Row> rows_;               ///< of the maps
};

}  // namespace bch::detail
