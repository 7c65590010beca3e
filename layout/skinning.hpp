// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>
#include <vector>

#include "layout/character.hpp"

namespace bch {

/// Poses one character again and again without allocating after the first time.
class Skinner {
 public:
  /// The character must outlive this and must be valid (see validate()).
  explicit Skinner(const Character& character);

  /// Linear blend skinning at a time of a clip, keys interpolated (rotations spherically), times clamped to
  /// the first and last key.
  /// Returns: one position a vertex, in metres, z up, relative to the root joint's point on the ground: a
  ///          clip that walks away leaves its shape where it is, while its yaw stays. Valid until the next
  ///          call.
  /// Errors:  throws std::invalid_argument on a clip or a time that is not there, std::domain_error on a
  ///          position that is not finite.
  std::span<const Eigen::Vector3f> pose(PoseTime at);

  const Character& character() const noexcept { return *character_; }

 private:
  const Character* character_;
  std::vector<const Channel*> channel_of_joint_;
  std::vector<Eigen::Affine3d> joint_to_world_;
  std::vector<Eigen::Affine3f> bone_to_shape_;
  std::vector<Eigen::Vector3f> positions_;

  void place_joints(PoseTime at);
  void place_bones();
};

}  // namespace bch
