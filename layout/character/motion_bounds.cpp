// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/character/motion_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "layout/character/eigen.hpp"

namespace bch::detail {
namespace {

MotionBound operator+(const MotionBound& a, const MotionBound& b) {
  return {a.value + b.value, a.speed + b.speed, a.acceleration + b.acceleration};
}
/// The product rule.
MotionBound operator*(const MotionBound& a, const MotionBound& b) {
  return {a.value * b.value, a.speed * b.value + a.value * b.speed,
          a.acceleration * b.value + 2 * a.speed * b.speed + a.value * b.acceleration};
}

double norm(const Affine3& map) {
  return Eigen::JacobiSVD<Eigen::Matrix3d>(to_eigen(map).linear().cast<double>()).singularValues()[0];
}
double size_of(const Vec3& v) {
  return to_eigen(v).cast<double>().norm();
}

/// Bounds the angle between two rotations: with half their quaternions' distance h, it is 4 asin(h) <= 4 h / sqrt(1 - h^2).
double angle_bound(const Quaternion& a, const Quaternion& b) {
  const Eigen::Vector4d from = to_eigen(a).coeffs().cast<double>(), to = to_eigen(b).coeffs().cast<double>();
  const double half = std::min((from - to).norm(), (from + to).norm()) / 2;
  return 4 * half / std::sqrt(1 - half * half);
}

/// Calls `bound` with the two keys around a time and the seconds between them; with the same key twice where the value rests.
template <class Value, class Bound>
MotionBound between_keys(const std::vector<Key<Value>>& keys, float from, const Bound& bound) {
  const auto after = std::upper_bound(keys.begin(), keys.end(), from,
                                      [](float time, const Key<Value>& key) { return time < key.time; });
  if (after == keys.begin()) return bound(keys.front().value, keys.front().value, 1.0);
  if (after == keys.end()) return bound(keys.back().value, keys.back().value, 1.0);
  const Key<Value>&a = *(after - 1), &b = *after;
  return bound(a.value, b.value, static_cast<double>(b.time) - static_cast<double>(a.time));
}

MotionBound linear_motion(const Vec3& a, const Vec3& b, double seconds) {
  const double distance = (to_eigen(b) - to_eigen(a)).cast<double>().norm();
  return {std::max(size_of(a), size_of(b)), distance / seconds, 0};
}

template <class Value>
void add_times(const std::vector<Key<Value>>& keys, float end, std::vector<float>& times) {
  for (const Key<Value>& key : keys)
    if (key.time > 0 && key.time < end) times.push_back(key.time);
}

/// Returns whether two keys have the same time, so that a value jumps.
template <class Value>
bool has_jump(const std::vector<Key<Value>>& keys) {
  return std::adjacent_find(keys.begin(), keys.end(), [](const Key<Value>& a, const Key<Value>& b) {
           return a.time == b.time;
         }) != keys.end();
}

bool is_linear(const Channel& channel) {
  if (has_jump(channel.positions) || has_jump(channel.rotations) || has_jump(channel.scales)) return false;
  constexpr Interpolation linear = Interpolation::linear;
  return (channel.positions.size() < 2 || channel.position_curve.interpolation == linear) &&
         (channel.rotations.size() < 2 || channel.rotation_curve.interpolation == linear) &&
         (channel.scales.size() < 2 || channel.scale_curve.interpolation == linear);
}

}  // namespace

MotionBounds::MotionBounds(const Character& character, std::uint32_t clip)
    : character_(&character), channel_of_joint_(character.joints.size()), joints_(character.joints.size()) {
  const auto reject = [&](const std::string& why) {
    throw std::invalid_argument("character '" + character.name + "': " + why);
  };
  if (clip >= character.clips.size()) reject("no clip " + std::to_string(clip));
  if (character.root_joint < 0) reject("an animated shape needs a root joint");
  const Clip& of = character.clips[clip];
  if (!(of.seconds > 0)) reject("clip '" + of.name + "' takes no time");
  key_times_ = {0, of.seconds};
  for (const Channel& channel : of.channels) {
    if (!is_linear(channel)) reject("clip '" + of.name + "' has channels that are not linear between keys");
    channel_of_joint_[channel.joint] = &channel;
    add_times(channel.positions, of.seconds, key_times_);
    add_times(channel.rotations, of.seconds, key_times_);
    add_times(channel.scales, of.seconds, key_times_);
  }
  std::sort(key_times_.begin(), key_times_.end());
  key_times_.erase(std::unique(key_times_.begin(), key_times_.end()), key_times_.end());
  for (const Joint& joint : character.joints) rest_norm_.push_back(norm(joint.rest));
  rest_norm_.push_back(norm(character.to_ground));
  for (std::size_t v = 0; v < character.vertices.size(); ++v)
    for (std::uint32_t i = character.influence_begin[v]; i < character.influence_begin[v + 1]; ++i)
      arm_.push_back((to_eigen(character.bones[character.influences[i].bone].inverse_bind).cast<double>() *
                      to_eigen(character.vertices[v]).cast<double>())
                         .norm());
}

MotionBound MotionBounds::local_linear(std::size_t joint, float from) const {
  const Channel* const channel = channel_of_joint_[joint];
  MotionBound rotation = {1, 0, 0}, scaling = {rest_norm_[joint], 0, 0};
  if (channel != nullptr && !channel->rotations.empty())
    rotation =
        between_keys(channel->rotations, from, [](const Quaternion& a, const Quaternion& b, double seconds) {
          const double speed = angle_bound(a, b) / seconds;
          return MotionBound{1, speed, speed * speed};
        });
  if (channel != nullptr && !channel->scales.empty())
    scaling = between_keys(channel->scales, from, linear_motion);
  return rotation * scaling;
}

MotionBound MotionBounds::local_origin(std::size_t joint, float from) const {
  const Channel* const channel = channel_of_joint_[joint];
  if (channel != nullptr && !channel->positions.empty())
    return between_keys(channel->positions, from, linear_motion);
  return {to_eigen(character_->joints[joint].rest).translation().cast<double>().norm(), 0, 0};
}

double MotionBounds::acceleration(float from) {
  const Character& c = *character_;
  const JointMotion ground = {{rest_norm_.back(), 0, 0}, {}, false};
  MotionBound root;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const std::int32_t up = c.joints[j].parent;
    const JointMotion& parent = up < 0 ? ground : joints_[static_cast<std::size_t>(up)];
    joints_[j] = {parent.linear * local_linear(j, from),
                  parent.linear * local_origin(j, from) + parent.origin, parent.below_root};
    if (static_cast<std::int32_t>(j) != c.root_joint) continue;
    root = joints_[j].origin;
    joints_[j].origin = {};
    joints_[j].below_root = true;
  }
  root_acceleration_ = root.acceleration;
  double most = 0;
  for (std::size_t v = 0; v < c.vertices.size(); ++v) {
    double sum = 0;
    for (std::uint32_t i = c.influence_begin[v]; i < c.influence_begin[v + 1]; ++i) {
      const JointMotion& joint = joints_[c.bones[c.influences[i].bone].joint];
      const double origin = joint.origin.acceleration + (joint.below_root ? 0 : root.acceleration);
      sum += static_cast<double>(c.influences[i].weight) * (joint.linear.acceleration * arm_[i] + origin);
    }
    most = std::max(most, sum);
  }
  return most;
}

}  // namespace bch::detail
