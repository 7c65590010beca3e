// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <bch/characters.hpp>
#include <bch/geometry.hpp>
#include <bch/poses.hpp>

#include "layout/base/aligned_vector.hpp"
#include "layout/character/blend_loops.hpp"

namespace bch::detail {

/// Holds the weight of a bone in the position of a point, and where the point is in that bone's frame.
struct PointInfluence {
  std::uint32_t bone;
  float weight;
  Vec3 at;
};

/// Returns those of a character's vertices: as many, in the same order, as Character::influences.
std::vector<PointInfluence> influences_of(const Character& character);

/// Represents a mesh that its bones move: each vertex goes to the mean of where they take it, weighted. What does not depend on the pose is
/// done once: a vertex is multiplied by its weights, so that every bone adds one product, and vertices stand in pairs.
class VertexBlend {
 public:
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
  template <class Position>
  std::optional<std::uint32_t> blend_all(std::span<const Affine3d> maps, std::span<Position> positions,
                                         bool (*loop)(const BlendPairs&, Position*) noexcept);

  std::vector<std::uint32_t> bones_;
  std::vector<BlendPairs::Run> runs_;
  AlignedVector<float> maps_, weighted_;  ///< see BlendPairs
  std::vector<std::uint32_t> first_;
  std::vector<PointPair> pairs_;
};

}  // namespace bch::detail
