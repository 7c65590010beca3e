// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/character/skinning.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "layout/base/shortest.hpp"
#include "layout/character/eigen.hpp"
#include "layout/character/rotation_blend.hpp"

namespace bch::detail {
namespace {

/// Returns the index of the first key after a time. The channels of a clip mostly have the same times, so the
/// last channel's place is tried first.
template <class Value>
std::size_t key_after(const std::vector<Key<Value>>& keys, float seconds, std::size_t guess) {
  if (guess > 0 && guess < keys.size() && keys[guess - 1].time <= seconds && seconds < keys[guess].time)
    return guess;
  const auto after = std::upper_bound(keys.begin(), keys.end(), seconds,
                                      [](float time, const Key<Value>& key) { return time < key.time; });
  return static_cast<std::size_t>(after - keys.begin());
}

Eigen::Vector3d blend(const Vec3& a, const Vec3& b, float t) {
  return (to_eigen(a) + t * (to_eigen(b) - to_eigen(a))).cast<double>();
}
Eigen::Quaterniond blend(const Quaternion& a, const Quaternion& b, float t) {
  return slerp(a, b, t);
}

/// A point of a cubic curve as a value; `earlier` is the key before it.
Eigen::Vector3d value_of(const Eigen::Vector3d& point, const Vec3&) {
  return point;
}
Eigen::Quaterniond value_of(const Eigen::Vector4d& point, const Quaternion& earlier) {
  constexpr double least_norm = 1e-6;  // keys of opposite signs lead through 0, which is no rotation
  const double norm = std::sqrt(point.squaredNorm());
  return norm < least_norm ? to_eigen(earlier).cast<double>() : Eigen::Quaterniond(point / norm);
}

/// The cubic Hermite spline of glTF 2.0, appendix C.5, between key a and the next one.
template <class Value>
auto cubic(const std::vector<Key<Value>>& keys, const Curve<Value>& curve, std::size_t a, float seconds) {
  const Key<Value>&from = keys[a], &to = keys[a + 1];
  const double length = static_cast<double>(to.time) - static_cast<double>(from.time);
  const double t = (static_cast<double>(seconds) - static_cast<double>(from.time)) / length;
  const double rest = 1 - t;
  const auto point = (rest * rest * (1 + 2 * t) * coefficients(from.value).template cast<double>() +
                      t * t * (3 - 2 * t) * coefficients(to.value).template cast<double>() +
                      length * t * rest * rest * coefficients(curve.tangents[a].out).template cast<double>() -
                      length * t * t * rest * coefficients(curve.tangents[a + 1].in).template cast<double>())
                         .eval();
  return value_of(point, from.value);
}

/// The value at a time; before the first key and behind the last one theirs.
template <class Value>
auto interpolate(const std::vector<Key<Value>>& keys, const Curve<Value>& curve, float seconds,
                 std::size_t& guess) {
  const std::size_t after = guess = key_after(keys, seconds, guess);
  const Key<Value>&a = keys[after == 0 ? 0 : after - 1], &b = keys[after == keys.size() ? after - 1 : after];
  if (&a != &b && curve.interpolation == Interpolation::cubic) return cubic(keys, curve, after - 1, seconds);
  const bool holds = &a == &b || curve.interpolation == Interpolation::step;
  return blend(a.value, b.value, holds ? 0 : (seconds - a.time) / (b.time - a.time));
}

template <class Position>
auto from_above(Position& position) {
  return Eigen::Map<Eigen::Vector2f>(&position.x);
}

/// Moves the middle of the positions' box, seen from above, to the origin.
template <class Position>
void put_middle_at_origin(std::vector<Position>& positions) {
  Eigen::AlignedBox2f box;
  for (Position& position : positions) box.extend(from_above(position));
  const Eigen::Vector2f middle = box.center();
  for (Position& position : positions) from_above(position) -= middle;
}

AffineRows linear_rows(const Eigen::Matrix3d& linear) {
  AffineRows rows;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) rows.row[i][j] = linear(i, j);
  return rows;
}

}  // namespace

Skinner::Skinner(const Character& character)
    : character_(&character),
      channel_of_joint_(character.joints.size()),
      to_ground_(character.to_ground),
      joint_to_world_(character.joints.size()),
      blend_(character) {
  for (const Joint& joint : character.joints) {
    Eigen::Matrix3f rotation, scaling;
    to_eigen(joint.rest).computeRotationScaling(&rotation, &scaling);
    rest_.push_back(
        {AffineRows(joint.rest), linear_rows(rotation.cast<double>()), linear_rows(scaling.cast<double>())});
  }
  for (const std::uint32_t bone : blend_.bones()) {
    joint_of_bone_.push_back(character.bones[bone].joint);
    inverse_bind_.emplace_back(character.bones[bone].inverse_bind);
  }
  bone_to_shape_.resize(inverse_bind_.size());
}

/// The joint relative to its parent. Only the parts that the channel animates replace those of the rest
/// transform. `guess`: where keys of this time were last.
AffineRows Skinner::local_transform(std::size_t joint, float seconds, std::size_t& guess) const {
  const auto& [rest, rest_rotation, rest_scaling] = rest_[joint];
  const Channel* const channel = channel_of_joint_[joint];
  if (channel == nullptr) return rest;
  AffineRows local = rest;
  if (!channel->rotations.empty() || !channel->scales.empty()) {
    AffineRows rotation = rest_rotation, scaling = rest_scaling;
    if (!channel->rotations.empty())
      rotation = linear_rows(
          interpolate(channel->rotations, channel->rotation_curve, seconds, guess).toRotationMatrix());
    if (!channel->scales.empty())
      scaling = linear_rows(
          interpolate(channel->scales, channel->scale_curve, seconds, guess).asDiagonal().toDenseMatrix());
    local = rotation * scaling;
    for (int i = 0; i < 3; ++i) local.row[i][3] = rest.row[i][3];
  }
  if (!channel->positions.empty()) {
    const Eigen::Vector3d position = interpolate(channel->positions, channel->position_curve, seconds, guess);
    for (int i = 0; i < 3; ++i) local.row[i][3] = position[i];
  }
  return local;
}

void Skinner::place_joints(PoseTime at) {
  std::fill(channel_of_joint_.begin(), channel_of_joint_.end(), nullptr);
  if (at.clip != PoseTime::rest)
    for (const Channel& channel : character_->clips[at.clip].channels)
      channel_of_joint_[channel.joint] = &channel;

  std::size_t guess = 0;
  for (std::size_t j = 0; j < joint_to_world_.size(); ++j) {
    const std::int32_t parent = character_->joints[j].parent;
    joint_to_world_[j] = (parent < 0 ? to_ground_ : joint_to_world_[static_cast<std::size_t>(parent)]) *
                         local_transform(j, at.seconds, guess);
  }
}

/// The root's way is taken out in double and before the vertices are touched: a pose metres away from the
/// file's origin would otherwise lose bits that the same pose at the origin keeps.
void Skinner::place_bones() {
  double origin[2] = {};
  if (character_->root_joint >= 0) {
    const AffineRows& root = joint_to_world_[static_cast<std::size_t>(character_->root_joint)];
    for (int i = 0; i < 2; ++i) origin[i] = root.row[i][3];
  }
  for (std::size_t b = 0; b < bone_to_shape_.size(); ++b) {
    AffineRows to_shape = joint_to_world_[joint_of_bone_[b]];
    for (int i = 0; i < 2; ++i) to_shape.row[i][3] -= origin[i];
    bone_to_shape_[b] = to_shape * inverse_bind_[b];
  }
}

template <class Position>
void Skinner::place_vertices(PoseTime at, std::vector<Position>& positions) {
  const Character& c = *character_;
  if (at.clip != PoseTime::rest) {
    if (at.clip >= c.clips.size())
      throw std::invalid_argument("character '" + c.name + "' has no clip " + std::to_string(at.clip));
    if (!(at.seconds >= 0 && at.seconds <= c.clips[at.clip].seconds))
      throw std::invalid_argument("clip '" + c.clips[at.clip].name + "' has no time " + shortest(at.seconds) +
                                  " s");
  }
  place_joints(at);
  place_bones();

  positions.resize(c.vertices.size());
  if (const auto vertex = blend_.blend(bone_to_shape_, std::span(positions)))
    throw std::domain_error("character '" + c.name + "': posed vertex " + std::to_string(*vertex) +
                            " is not finite");
  if (c.root_joint < 0) put_middle_at_origin(positions);
}

std::span<const Vec3> Skinner::pose(PoseTime at) {
  place_vertices(at, positions_);
  return positions_;
}

std::span<const Vec2> Skinner::ground_pose(PoseTime at) {
  place_vertices(at, ground_positions_);
  return ground_positions_;
}

}  // namespace bch::detail
