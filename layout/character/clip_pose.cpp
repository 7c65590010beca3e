// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/character/clip_pose.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "layout/base/number_class.hpp"
#include "layout/base/shortest.hpp"
#include "layout/character/affine_rows.hpp"
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

Eigen::Vector3d between(const Vec3& a, const Vec3& b, float t) {
  return (to_eigen(a) + t * (to_eigen(b) - to_eigen(a))).cast<double>();
}
Eigen::Quaterniond between(const Quaternion& a, const Quaternion& b, float t) {
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
  return between(a.value, b.value, holds ? 0 : (seconds - a.time) / (b.time - a.time));
}

Affine3d affine(const Eigen::Matrix3d& linear, const Eigen::Vector3d& translation = Eigen::Vector3d::Zero()) {
  Affine3d map;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) map.rows[i][j] = linear(i, j);
    map.rows[i][3] = translation[i];
  }
  return map;
}
Eigen::Matrix3d linear_part(const Affine3d& map) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(map.rows[0]).leftCols<3>();
}
Eigen::Vector3d translation_of(const Affine3d& map) {
  return {map.rows[0][3], map.rows[1][3], map.rows[2][3]};
}
void set_translation(Affine3d& map, const Eigen::Vector3d& translation) {
  for (int i = 0; i < 3; ++i) map.rows[i][3] = translation[i];
}

/// Returns the sum of weights.
/// Errors:  throws std::invalid_argument on a negative or non-finite weight, or where all weights are 0.
double total_weight(std::span<const WeightedPose> poses) {
  double total = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const float weight = poses[i].weight;
    if (!(weight >= 0 && is_finite(weight)))
      throw std::invalid_argument("blend: expected weights from 0 on, found " + shortest(weight) +
                                  " of pose " + std::to_string(i));
    total += static_cast<double>(weight);
  }
  if (!(total > 0)) throw std::invalid_argument("blend: expected a weight above 0, found none");
  return total;
}

}  // namespace

ClipPose::ClipPose(const Character& character)
    : character_(&character), channel_of_joint_(character.joints.size()) {
  for (const Joint& joint : character.joints) {
    Eigen::Matrix3f rotation, scaling;
    to_eigen(joint.rest).computeRotationScaling(&rotation, &scaling);
    const Eigen::Matrix3d turn = rotation.cast<double>();
    rest_.push_back(
        {widened(joint.rest), affine(turn), affine(scaling.cast<double>()), Eigen::Quaterniond(turn)});
  }
}

void ClipPose::find_channels(PoseTime at) {
  const Character& c = *character_;
  std::fill(channel_of_joint_.begin(), channel_of_joint_.end(), nullptr);
  if (at.clip == PoseTime::rest) return;
  if (at.clip >= c.clips.size())
    throw std::invalid_argument("character '" + c.name + "' has no clip " + std::to_string(at.clip));
  const Clip& clip = c.clips[at.clip];
  if (!(at.seconds >= 0 && at.seconds <= clip.seconds))
    throw std::invalid_argument("clip '" + clip.name + "' has no time " + shortest(at.seconds) + " s");
  for (const Channel& channel : clip.channels) channel_of_joint_[channel.joint] = &channel;
}

/// Asks for the keys about a time, which are far apart in memory, before they are read one after the other. Returns where they are.
std::size_t ClipPose::prefetch(float seconds) const {
  std::size_t guess = 0;
  const auto fetch = [&guess, seconds](const auto& keys) {
    if (keys.size() < 2) return;
    guess = guess == 0 ? key_after(keys, seconds, 0) : guess;
    const std::size_t after = std::min(guess, keys.size() - 1);
    __builtin_prefetch(&keys[after - std::min<std::size_t>(after, 1)]);
    __builtin_prefetch(&keys[after].value);
  };
  for (const Channel* const channel : channel_of_joint_)
    if (channel != nullptr) fetch(channel->rotations), fetch(channel->positions);
  return guess;
}

/// `guess`: where keys of this time were last.
ClipPose::Moved ClipPose::moved(std::size_t joint, float seconds, std::size_t& guess) const {
  Moved parts;
  const Channel* const channel = channel_of_joint_[joint];
  if (channel == nullptr) return parts;
  if (!channel->rotations.empty())
    parts.rotation = interpolate(channel->rotations, channel->rotation_curve, seconds, guess);
  if (!channel->scales.empty())
    parts.scale = interpolate(channel->scales, channel->scale_curve, seconds, guess);
  if (!channel->positions.empty())
    parts.position = interpolate(channel->positions, channel->position_curve, seconds, guess);
  return parts;
}

void ClipPose::place(PoseTime at, std::span<Affine3d> local) {
  find_channels(at);
  std::size_t guess = prefetch(at.seconds);
  for (std::size_t j = 0; j < local.size(); ++j) {
    const Rest& rest = rest_[j];
    const Moved by = moved(j, at.seconds, guess);
    local[j] = rest.whole;
    if (by.rotation || by.scale) {
      local[j] = (by.rotation ? affine(by.rotation->toRotationMatrix()) : rest.rotation) *
                 (by.scale ? affine(by.scale->asDiagonal().toDenseMatrix()) : rest.scaling);
      set_translation(local[j], translation_of(rest.whole));
    }
    if (by.position) set_translation(local[j], *by.position);
  }
}

void ClipPose::add(std::size_t joint, const Moved& by, double fraction) {
  const Rest& rest = rest_[joint];
  Sum& sum = sums_[joint];
  const Eigen::Quaterniond turn = by.rotation.value_or(rest.turn);
  // A sum only grows by what is on its side, so it has a direction.
  sum.rotation += (sum.rotation.dot(turn.coeffs()) < 0 ? -fraction : fraction) * turn.coeffs();
  sum.scaling += fraction * (by.scale ? by.scale->asDiagonal().toDenseMatrix() : linear_part(rest.scaling));
  sum.position += fraction * by.position.value_or(translation_of(rest.whole));
  sum.is_moved = sum.is_moved || by.rotation || by.scale || by.position;
}

void ClipPose::blend(std::span<const WeightedPose> poses, std::span<Affine3d> local) {
  const double total = total_weight(poses);
  sums_.assign(local.size(),
               {Eigen::Vector4d::Zero(), Eigen::Matrix3d::Zero(), Eigen::Vector3d::Zero(), false});
  for (const auto& [at, weight] : poses) {
    find_channels(at);
    const double fraction = static_cast<double>(weight) / total;
    if (fraction == 1) return place(at, local);
    if (fraction == 0) continue;
    std::size_t guess = 0;
    for (std::size_t j = 0; j < local.size(); ++j) add(j, moved(j, at.seconds, guess), fraction);
  }
  for (std::size_t j = 0; j < local.size(); ++j) {
    const Sum& sum = sums_[j];
    local[j] = rest_[j].whole;
    if (!sum.is_moved) continue;
    const Eigen::Quaterniond turn(sum.rotation / std::sqrt(sum.rotation.squaredNorm()));
    local[j] = affine(turn.toRotationMatrix()) * affine(sum.scaling);
    set_translation(local[j], sum.position);
  }
}

}  // namespace bch::detail
