// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/skinning.hpp"

#include <algorithm>
#include <stdexcept>

namespace bch {
namespace {

template <class Value, class Blend>
Value interpolate(const std::vector<Key<Value>>& keys, float seconds, Blend blend) {
  const auto after = std::upper_bound(keys.begin(), keys.end(), seconds,
                                      [](float time, const Key<Value>& key) { return time < key.time; });
  if (after == keys.begin()) return keys.front().value;
  if (after == keys.end()) return keys.back().value;
  const Key<Value>& before = *(after - 1);
  return blend(before.value, after->value, (seconds - before.time) / (after->time - before.time));
}

Eigen::Vector3f interpolate(const std::vector<Key<Eigen::Vector3f>>& keys, float seconds) {
  return interpolate(keys, seconds, [](const Eigen::Vector3f& a, const Eigen::Vector3f& b, float t) {
    return Eigen::Vector3f(a + t * (b - a));
  });
}

Eigen::Quaternionf interpolate(const std::vector<Key<Eigen::Quaternionf>>& keys, float seconds) {
  return interpolate(keys, seconds, [](const Eigen::Quaternionf& a, const Eigen::Quaternionf& b, float t) {
    return a.slerp(t, b);
  });
}

/// The joint relative to its parent. Only the parts that the channel animates replace those of the rest
/// transform.
Eigen::Affine3d local_transform(const Joint& joint, const Channel* channel, float seconds) {
  if (channel == nullptr) return joint.rest.cast<double>();
  Eigen::Vector3f position = joint.rest.translation();
  Eigen::Matrix3f rotation_scale = joint.rest.linear();
  if (!channel->rotations.empty() || !channel->scales.empty()) {
    Eigen::Matrix3f rotation;
    Eigen::Matrix3f scaling;
    joint.rest.computeRotationScaling(&rotation, &scaling);
    if (!channel->rotations.empty())
      rotation = interpolate(channel->rotations, seconds).normalized().toRotationMatrix();
    if (!channel->scales.empty()) scaling = interpolate(channel->scales, seconds).asDiagonal();
    rotation_scale = rotation * scaling;
  }
  if (!channel->positions.empty()) position = interpolate(channel->positions, seconds);

  Eigen::Affine3d local = Eigen::Affine3d::Identity();
  local.linear() = rotation_scale.cast<double>();
  local.translation() = position.cast<double>();
  return local;
}

}  // namespace

Skinner::Skinner(const Character& character)
    : character_(&character),
      channel_of_joint_(character.joints.size()),
      joint_to_world_(character.joints.size()),
      bone_to_shape_(character.bones.size()),
      positions_(character.vertices.size()) {}

void Skinner::place_joints(PoseTime at) {
  std::fill(channel_of_joint_.begin(), channel_of_joint_.end(), nullptr);
  if (at.clip != PoseTime::rest)
    for (const Channel& channel : character_->clips[at.clip].channels)
      channel_of_joint_[channel.joint] = &channel;

  const Eigen::Affine3d to_ground = character_->to_ground.cast<double>();
  for (std::size_t j = 0; j < joint_to_world_.size(); ++j) {
    const Joint& joint = character_->joints[j];
    const Eigen::Affine3d& parent = joint.parent < 0 ? to_ground : joint_to_world_[joint.parent];
    joint_to_world_[j] = parent * local_transform(joint, channel_of_joint_[j], at.seconds);
  }
}

/// The root's way is taken out in double and before the vertices are touched: a pose metres away from the
/// file's origin would otherwise lose bits that the same pose at the origin keeps.
void Skinner::place_bones() {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  if (character_->root_joint >= 0) origin = joint_to_world_[character_->root_joint].translation();
  origin.z() = 0;
  for (std::size_t b = 0; b < bone_to_shape_.size(); ++b) {
    const Bone& bone = character_->bones[b];
    Eigen::Affine3d to_shape = joint_to_world_[bone.joint];
    to_shape.translation() -= origin;
    bone_to_shape_[b] = (to_shape * bone.inverse_bind.cast<double>()).cast<float>();
  }
}

std::span<const Eigen::Vector3f> Skinner::pose(PoseTime at) {
  const Character& c = *character_;
  if (at.clip != PoseTime::rest) {
    if (at.clip >= c.clips.size())
      throw std::invalid_argument("character '" + c.name + "' has no clip " + std::to_string(at.clip));
    if (!(at.seconds >= 0 && at.seconds <= c.clips[at.clip].seconds))
      throw std::invalid_argument("clip '" + c.clips[at.clip].name + "' has no time " +
                                  std::to_string(at.seconds) + " s");
  }
  place_joints(at);
  place_bones();

  for (std::size_t v = 0; v < c.vertices.size(); ++v) {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (std::uint32_t i = c.influence_begin[v]; i < c.influence_begin[v + 1]; ++i)
      sum += c.influences[i].weight * (bone_to_shape_[c.influences[i].bone] * c.vertices[v]);
    if (!sum.allFinite())
      throw std::domain_error("character '" + c.name + "': posed vertex " + std::to_string(v) +
                              " is not finite");
    positions_[v] = sum;
  }

  if (c.root_joint < 0) {
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f& position : positions_) box.extend(position);
    Eigen::Vector3f middle = box.center();
    middle.z() = 0;
    for (Eigen::Vector3f& position : positions_) position -= middle;
  }
  return positions_;
}

}  // namespace bch
