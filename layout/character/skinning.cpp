// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/character/skinning.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "layout/base/number_class.hpp"
#include "layout/character/affine_rows.hpp"
#include "layout/character/clip_pose.hpp"
#include "layout/character/middle.hpp"

namespace bch::detail {
namespace {

void move_on_ground(Affine3d& map, double x, double y) {
  map.rows[0][3] += x;
  map.rows[1][3] += y;
}

void require_count(std::size_t expected, const char* what, std::size_t found) {
  if (found != expected)
    throw std::invalid_argument("shape: expected " + std::to_string(expected) + " " + what + ", found " +
                                std::to_string(found));
}
void require_finite(bool finite, const char* what, std::size_t i) {
  if (!finite)
    throw std::invalid_argument("shape: expected finite " + std::string(what) + ", found others at index " +
                                std::to_string(i));
}

Affine3d finite_map(const Transforms& maps, std::size_t i, const char* what) {
  const Affine3d map = maps[i];
  bool finite = true;
  for (const auto& row : map.rows)
    for (const double number : row) finite = finite && is_finite(number);
  require_finite(finite, what, i);
  return map;
}

void take_joints(const Transforms& maps, std::vector<Affine3d>& to) {
  constexpr const char* what = "joint transforms";
  require_count(to.size(), what, maps.size());
  for (std::size_t j = 0; j < to.size(); ++j) to[j] = finite_map(maps, j, what);
}

void put(const Vec3& position, Vec3& to) {
  to = position;
}
void put(const Vec3& position, Vec2& to) {
  to = {position.x, position.y};
}

template <class Position>
void take_vertices(std::span<const Vec3> from, std::vector<Position>& to) {
  const auto are_finite = [](const Vec3& v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); };
  constexpr const char* what = "posed vertices";
  require_count(to.size(), what, from.size());
  unsigned finite = 1;  // all of them, so that the loop is done by whole registers
  for (std::size_t v = 0; v < from.size(); ++v) {
    finite &= are_finite(from[v]);
    put(from[v], to[v]);
  }
  if (finite == 0)
    for (std::size_t v = 0; v < from.size(); ++v) require_finite(are_finite(from[v]), what, v);
}

}  // namespace

Skinner::Skinner(Skinner&&) noexcept = default;
Skinner& Skinner::operator=(Skinner&&) noexcept = default;
Skinner::~Skinner() = default;

Skinner::Skinner(const Character& character)
    : character_(&character),
      clip_pose_(std::make_unique<ClipPose>(character)),
      to_ground_(widened(character.to_ground)),
      joint_to_parent_(character.joints.size()),
      joint_to_world_(character.joints.size()),
      blend_(character) {
  for (const std::uint32_t bone : blend_.bones()) {
    joint_of_bone_.push_back(character.bones[bone].joint);
    inverse_bind_.push_back(widened(character.bones[bone].inverse_bind));
  }
  bone_to_shape_.resize(inverse_bind_.size());
}

void Skinner::place_joints() {
  for (std::size_t j = 0; j < joint_to_world_.size(); ++j) {
    const std::int32_t parent = character_->joints[j].parent;
    joint_to_world_[j] =
        (parent < 0 ? to_ground_ : joint_to_world_[static_cast<std::size_t>(parent)]) * joint_to_parent_[j];
  }
}

/// The root's translation is taken out in double and before the vertices are touched: a pose metres away from the
/// file's origin would otherwise lose bits that the same pose at the origin keeps.
void Skinner::place_bones() {
  double origin[2] = {};
  if (character_->root_joint >= 0) {
    const Affine3d& root = joint_to_world_[static_cast<std::size_t>(character_->root_joint)];
    for (int i = 0; i < 2; ++i) origin[i] = root.rows[i][3];
  }
  for (std::size_t b = 0; b < bone_to_shape_.size(); ++b) {
    Affine3d to_shape = joint_to_world_[joint_of_bone_[b]];
    move_on_ground(to_shape, -origin[0], -origin[1]);
    bone_to_shape_[b] = to_shape * inverse_bind_[b];
  }
}

void Skinner::place(PoseTime at) {
  clip_pose_->place(at, joint_to_parent_);
  place_joints();
  place_bones();
}

void Skinner::place(const LocalPose& pose) {
  take_joints(pose.joints, joint_to_parent_);
  place_joints();
  place_bones();
}

void Skinner::place(const WorldPose& pose) {
  take_joints(pose.joints, joint_to_world_);
  place_bones();
}

void Skinner::place(const SkinningPalette& pose) {
  constexpr const char* what = "bone matrices";
  require_count(character_->bones.size(), what, pose.bones.size());
  require_finite(is_finite(pose.x) && is_finite(pose.y), "origins", 0);
  for (std::size_t b = 0; b < bone_to_shape_.size(); ++b) {
    bone_to_shape_[b] = finite_map(pose.bones, blend_.bones()[b], what);
    move_on_ground(bone_to_shape_[b], -pose.x, -pose.y);
  }
}

void Skinner::place_bones_of(const Pose& pose) {
  std::visit(
      [&]<class Kind>(const Kind& kind) {
        if constexpr (std::is_same_v<Kind, PosedVertices>)
          throw std::invalid_argument(
              "pose: expected transforms or a time of a clip, found vertices, which do not say where bones "
              "are");
        else
          place(kind);
      },
      pose.kind());
}

template <class Position>
std::span<const Position> Skinner::place_vertices(const Pose& pose, std::vector<Position>& positions) {
  positions.resize(character_->vertices.size());
  if (const auto* const posed = std::get_if<PosedVertices>(&pose.kind())) {
    take_vertices(posed->positions, positions);
    return positions;
  }
  place_bones_of(pose);
  if (const auto vertex = blend_.blend(bone_to_shape_, std::span(positions)))
    throw std::domain_error("character '" + character_->name + "': posed vertex " + std::to_string(*vertex) +
                            " is not finite");
  if (character_->root_joint < 0) {
    middle_ = middle_of(std::span<const Position>(positions));
    move_by(std::span(positions), {-middle_.x, -middle_.y});
  }
  return positions;
}

std::span<const Vec3> Skinner::pose(const Pose& pose) {
  return place_vertices(pose, positions_);
}

std::span<const Vec2> Skinner::ground_pose(const Pose& pose) {
  return place_vertices(pose, ground_positions_);
}

std::span<const Affine3d> Skinner::joints(PoseTime at, JointFrame frame) {
  clip_pose_->place(at, joint_to_parent_);
  if (frame == JointFrame::parent) return joint_to_parent_;
  place_joints();
  return joint_to_world_;
}

std::span<const Affine3d> Skinner::blend(std::span<const WeightedPose> poses) {
  clip_pose_->blend(poses, joint_to_parent_);
  return joint_to_parent_;
}

}  // namespace bch::detail
