// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <memory>
#include <span>
#include <vector>

#include <bch/characters.hpp>
#include <bch/geometry.hpp>
#include <bch/poses.hpp>

#include "layout/character/vertex_blend.hpp"

namespace bch::detail {

class ClipPose;

/// Poses one character again and again without allocating after the first time. A pose goes one way, from wherever it comes in: clip,
/// joints in their parents' frames, joints in the world, bones, vertices.
class Skinner {
 public:
  /// Takes a character, which must outlive this and must be valid (see validate()).
  explicit Skinner(const Character& character);
  Skinner(Skinner&&) noexcept;
  Skinner& operator=(Skinner&&) noexcept;
  ~Skinner();

  /// Poses the mesh by linear blend skinning.
  /// Returns: one position a vertex, in metres, z up, relative to the root joint's point on the ground: a
  ///          clip that walks away leaves its shape where it is, while its yaw stays. Valid until the next
  ///          call.
  /// Errors:  throws std::invalid_argument on a clip or a time that is not there, on another number of transforms or positions than of
  ///          joints, bones or vertices, and on one that is not finite; std::domain_error on a position that is not finite.
  std::span<const Vec3> pose(const Pose& pose);

  /// Returns x and y of pose(), with the same bits, in three quarters of the time. Heights may have any
  /// value.
  std::span<const Vec2> ground_pose(const Pose& pose);

  /// Returns the transforms of all joints at a time of a clip, valid until the next call.
  std::span<const Affine3d> joints(PoseTime at, JointFrame frame);
  /// Returns those of a blend(), in the frames of the parents.
  std::span<const Affine3d> blend(std::span<const WeightedPose> poses);

  const Character& character() const noexcept { return *character_; }

  /// Places the bones of a pose, which is not one of vertices; see bone_maps().
  /// Errors:  as pose(); throws std::invalid_argument on a pose of vertices.
  void place_bones_of(const Pose& pose);
  /// Returns the bones that move a vertex, in order.
  std::span<const std::uint32_t> bones() const noexcept { return blend_.bones(); }
  /// Returns the maps from the frames of these bones' inverse_binds to the shape of the last pose, which was not one of vertices. Of a
  /// shape without a root joint, pose() then moved the middle() to the origin.
  std::span<const Affine3d> bone_maps() const noexcept { return bone_to_shape_; }
  Vec2 middle() const noexcept { return middle_; }

 private:
  void place_joints();
  void place_bones();
  void place(PoseTime at);
  void place(const LocalPose& pose);
  void place(const WorldPose& pose);
  void place(const SkinningPalette& pose);
  template <class Position>
  std::span<const Position> place_vertices(const Pose& pose, std::vector<Position>& positions);

  const Character* character_;
  std::unique_ptr<ClipPose> clip_pose_;  // Who poses needs no Eigen.
  Affine3d to_ground_;
  std::vector<Affine3d> joint_to_parent_, joint_to_world_;
  VertexBlend blend_;
  // These arrays hold the bones that move a vertex.
  std::vector<std::uint32_t> joint_of_bone_;
  std::vector<Affine3d> inverse_bind_, bone_to_shape_;
  Vec2 middle_;  ///< of a shape without a root joint
  // These arrays hold the vertices. Each one gets its memory when its function is called first.
  std::vector<Vec3> positions_;
  std::vector<Vec2> ground_positions_;
};

}  // namespace bch::detail
