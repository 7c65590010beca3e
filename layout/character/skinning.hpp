// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>
#include <vector>

#include <bch/character.hpp>
#include <bch/geometry.hpp>

#include "layout/character/affine_rows.hpp"
#include "layout/character/vertex_blend.hpp"

namespace bch::detail {

/// Poses one character again and again without allocating after the first time.
class Skinner {
 public:
  /// Takes a character, which must outlive this and must be valid (see validate()).
  explicit Skinner(const Character& character);

  /// Poses the mesh by linear blend skinning at a time of a clip, keys interpolated as the channels' curves say, times clamped to
  /// the first and last key.
  /// Returns: one position a vertex, in metres, z up, relative to the root joint's point on the ground: a
  ///          clip that walks away leaves its shape where it is, while its yaw stays. Valid until the next
  ///          call.
  /// Errors:  throws std::invalid_argument on a clip or a time that is not there, std::domain_error on a
  ///          position that is not finite.
  std::span<const Vec3> pose(PoseTime at);

  /// Returns x and y of pose(), with the same bits, in three quarters of the time. Heights may have any
  /// value.
  std::span<const Vec2> ground_pose(PoseTime at);

  const Character& character() const noexcept { return *character_; }

 private:
  /// Represents a joint relative to its parent where no clip moves it, and its linear part's factors.
  struct Rest {
    AffineRows whole, rotation, scaling;
  };

  AffineRows local_transform(std::size_t joint, float seconds, std::size_t& guess) const;
  void place_joints(PoseTime at);
  void place_bones();
  template <class Position>
  void place_vertices(PoseTime at, std::vector<Position>& positions);

  const Character* character_;
  std::vector<Rest> rest_;
  std::vector<const Channel*> channel_of_joint_;
  AffineRows to_ground_;
  std::vector<AffineRows> joint_to_world_;
  VertexBlend blend_;
  // These arrays hold the bones that move a vertex.
  std::vector<std::uint32_t> joint_of_bone_;
  std::vector<AffineRows> inverse_bind_, bone_to_shape_;
  // These arrays hold the vertices. Each one gets its memory when its function is called first.
  std::vector<Vec3> positions_;
  std::vector<Vec2> ground_positions_;
};

}  // namespace bch::detail
