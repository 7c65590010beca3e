// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/characters.hpp>

#include <cmath>
#include <stdexcept>

#include "layout/base/floating_point_state.hpp"
#include "layout/base/number_class.hpp"
#include "layout/base/shortest.hpp"
#include "layout/character/eigen.hpp"

namespace bch {

using namespace detail;

namespace {

constexpr float unit_tolerance = 1e-3f;

[[noreturn]] void reject(const Character& character, const std::string& reason) {
  throw std::invalid_argument("character '" + character.name + "': " + reason);
}

std::string at(const char* what, std::size_t index) {
  return std::string(what) + " " + std::to_string(index);
}

void validate_joints(const Character& c) {
  for (std::size_t i = 0; i < c.joints.size(); ++i) {
    const Joint& joint = c.joints[i];
    if (joint.parent < -1 || joint.parent >= static_cast<std::int64_t>(i))
      reject(c, at("joint", i) + " has parent " + std::to_string(joint.parent) + ", not an earlier joint");
    if (!to_eigen(joint.rest).matrix().allFinite())
      reject(c, at("joint", i) + " has a rest transform that is not finite");
  }
  if (c.root_joint < -1 || c.root_joint >= static_cast<std::int64_t>(c.joints.size()))
    reject(c, "root joint " + std::to_string(c.root_joint) + " does not exist");
  if (!to_eigen(c.to_ground).matrix().allFinite())
    reject(c, "the transform to the ground frame is not finite");
  for (std::size_t i = 0; i < c.bones.size(); ++i) {
    if (c.bones[i].joint >= c.joints.size())
      reject(c, at("bone", i) + " names joint " + std::to_string(c.bones[i].joint));
    if (!to_eigen(c.bones[i].inverse_bind).matrix().allFinite())
      reject(c, at("bone", i) + " has a bind matrix that is not finite");
  }
}

void validate_influences(const Character& c) {
  if (c.influence_begin.size() != c.vertices.size() + 1 || c.influence_begin.front() != 0 ||
      c.influence_begin.back() != c.influences.size())
    reject(c, "influence offsets do not fit " + std::to_string(c.vertices.size()) + " vertices");
  for (std::size_t v = 0; v < c.vertices.size(); ++v) {
    if (!to_eigen(c.vertices[v]).allFinite()) reject(c, at("vertex", v) + " is not finite");
    if (c.influence_begin[v] >= c.influence_begin[v + 1]) reject(c, at("vertex", v) + " follows no bone");
    if (c.influence_begin[v + 1] > c.influences.size())
      reject(c, at("vertex", v) + " has offsets out of range");
    float sum = 0;
    for (std::uint32_t i = c.influence_begin[v]; i < c.influence_begin[v + 1]; ++i) {
      const Influence& influence = c.influences[i];
      if (influence.bone >= c.bones.size())
        reject(c, at("vertex", v) + " names bone " + std::to_string(influence.bone));
      if (!(influence.weight > 0)) reject(c, at("vertex", v) + " has weight " + shortest(influence.weight));
      sum += influence.weight;
    }
    if (!(std::abs(sum - 1) <= unit_tolerance))
      reject(c, at("vertex", v) + " has weights that sum to " + shortest(sum));
  }
}

template <class Value>
void validate_keys(const Character& c, const std::string& place, const std::vector<Key<Value>>& keys) {
  for (std::size_t k = 0; k < keys.size(); ++k) {
    if (!is_finite(keys[k].time) || (k > 0 && keys[k].time < keys[k - 1].time))
      reject(c, place + ", " + at("key", k) + " is at " + shortest(keys[k].time) + " s, out of order");
    const auto value = coefficients(keys[k].value);
    if constexpr (std::is_same_v<Value, Quaternion>) {
      if (!(std::abs(value.norm() - 1) <= unit_tolerance))
        reject(c, place + ", " + at("key", k) + " has a rotation of norm " + shortest(value.norm()));
    } else if (!value.allFinite()) {
      reject(c, place + ", " + at("key", k) + " is not finite");
    }
  }
}

template <class Value>
void validate_part(const Character& c, const std::string& place, const std::vector<Key<Value>>& keys,
                   const Curve<Value>& curve) {
  validate_keys(c, place, keys);
  if (curve.interpolation > Interpolation::cubic)
    reject(c, place + " has interpolation " + std::to_string(static_cast<int>(curve.interpolation)));
  const std::size_t tangents = curve.interpolation == Interpolation::cubic ? keys.size() : 0;
  if (curve.tangents.size() != tangents)
    reject(c, place + " has " + std::to_string(curve.tangents.size()) + " pairs of tangents, not " +
                  std::to_string(tangents));
  for (std::size_t k = 0; k < tangents; ++k)
    if (!coefficients(curve.tangents[k].in).allFinite() || !coefficients(curve.tangents[k].out).allFinite())
      reject(c, place + ", " + at("key", k) + " has tangents that are not finite");
}

void validate_clips(const Character& c) {
  for (const Clip& clip : c.clips) {
    if (!is_finite(clip.seconds) || clip.seconds < 0)
      reject(c, "clip '" + clip.name + "' lasts " + shortest(clip.seconds) + " s");
    std::vector<bool> seen(c.joints.size());
    for (const Channel& channel : clip.channels) {
      const std::string place = "clip '" + clip.name + "', joint " + std::to_string(channel.joint);
      if (channel.joint >= c.joints.size()) reject(c, place + " does not exist");
      if (seen[channel.joint]) reject(c, place + " has two channels");
      seen[channel.joint] = true;
      validate_part(c, place, channel.positions, channel.position_curve);
      validate_part(c, place, channel.rotations, channel.rotation_curve);
      validate_part(c, place, channel.scales, channel.scale_curve);
    }
  }
}

}  // namespace

void validate(const Character& c) {
  const FloatingPointStateGuard floats;
  if (c.triangles.empty()) reject(c, "no triangles");
  validate_joints(c);
  validate_influences(c);
  for (std::size_t t = 0; t < c.triangles.size(); ++t)
    for (const std::uint32_t vertex : c.triangles[t])
      if (vertex >= c.vertices.size())
        reject(c, at("triangle", t) + " names vertex " + std::to_string(vertex));
  validate_clips(c);
}

std::vector<PoseTime> sample_poses(const Character& character, std::uint32_t count) {
  const FloatingPointStateGuard floats;
  double total = 0;
  for (const Clip& clip : character.clips) total += static_cast<double>(clip.seconds);
  if (character.clips.empty()) return {PoseTime{}};

  std::vector<PoseTime> poses;
  poses.reserve(count);
  std::uint32_t clip = 0;
  double clip_begin = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double time = (i + 0.5) / count * total;
    while (clip + 1 < character.clips.size() &&
           time >= clip_begin + static_cast<double>(character.clips[clip].seconds))
      clip_begin += static_cast<double>(character.clips[clip++].seconds);
    poses.push_back({clip, static_cast<float>(time - clip_begin)});
  }
  return poses;
}

}  // namespace bch
