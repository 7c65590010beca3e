// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/clips.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "layout/base/number_class.hpp"
#include "layout/base/shortest.hpp"

namespace bch::detail::importing {
namespace {

constexpr double default_ticks_per_second = 25;  // what a reader is to assume where a file is silent
constexpr double longest_clip = 1e6;             // seconds

Vec3 value_of(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}
Quaternion value_of(const aiQuaternion& q) {
  return {q.x, q.y, q.z, q.w};
}

Vec3 quotient(const Vec3& v, float divisor) {
  return {v.x / divisor, v.y / divisor, v.z / divisor};
}
Quaternion quotient(const Quaternion& q, float divisor) {
  return {q.x / divisor, q.y / divisor, q.z / divisor, q.w / divisor};
}

/// Puts keys and their tangents in order of time.
template <class Value>
void sort_keys(std::vector<Key<Value>>& keys, std::vector<typename Curve<Value>::Tangents>& tangents) {
  std::vector<std::size_t> order(keys.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return keys[a].time < keys[b].time; });
  const std::vector<Key<Value>> unsorted = keys;
  const std::vector<typename Curve<Value>::Tangents> unsorted_tangents = tangents;
  for (std::size_t k = 0; k < keys.size(); ++k) keys[k] = unsorted[order[k]];
  for (std::size_t k = 0; k < tangents.size(); ++k) tangents[k] = unsorted_tangents[order[k]];
}

template <class Value>
bool is_constant(const std::vector<Key<Value>>& keys, const Curve<Value>& curve) {
  const bool equal = std::all_of(keys.begin(), keys.end(),
                                 [&](const Key<Value>& key) { return key.value == keys.front().value; });
  return equal && std::all_of(curve.tangents.begin(), curve.tangents.end(), [](const auto& t) {
           return coefficients(t.in).isZero(0) && coefficients(t.out).isZero(0);
         });
}

/// Reads one animation.
class ClipReader {
 public:
  ClipReader(const SceneFile& file, const aiAnimation& animation, std::string name)
      : file_(file), animation_(animation), ticks_per_second_(animation.mTicksPerSecond) {
    clip_.name = std::move(name);
    if (!(is_finite(ticks_per_second_) && ticks_per_second_ > 0))
      ticks_per_second_ = default_ticks_per_second;
  }

  SourceClip read(std::vector<std::string>& notes) {
    if (animation_.mNumChannels > 0 && animation_.mChannels == nullptr)
      file_.reject("clip '" + clip_.name + "' has no channels where it says so");
    for (unsigned c = 0; c < animation_.mNumChannels; ++c) read_channel(animation_.mChannels[c]);
    set_length();
    add_notes(notes);
    return std::move(clip_);
  }

 private:
  const SceneFile& file_;
  const aiAnimation& animation_;
  double ticks_per_second_;
  SourceClip clip_;
  std::set<std::string> seen_;
  std::string place_;
  float first_ = 0;  // at most 0: keys may start late, as a clip does, but none may be lost
  float last_ = 0;
  std::size_t repeated_ = 0;
  std::size_t unordered_ = 0;
  std::size_t normalised_ = 0;

  void read_channel(const aiNodeAnim* source) {
    if (source == nullptr) file_.reject("clip '" + clip_.name + "' has a missing channel");
    SourceChannel channel;
    channel.node = to_string(source->mNodeName);
    place_ = "clip '" + clip_.name + "', channel of '" + channel.node + "'";
    const auto how = file_.gltf.interpolations.find(source);
    const auto [positions, rotations, scales] =
        how == file_.gltf.interpolations.end() ? ChannelInterpolation() : how->second;
    Channel& motion = channel.motion;
    read_part(source->mPositionKeys, source->mNumPositionKeys, "position", positions, motion.positions,
              motion.position_curve);
    read_part(source->mRotationKeys, source->mNumRotationKeys, "rotation", rotations, motion.rotations,
              motion.rotation_curve);
    read_part(source->mScalingKeys, source->mNumScalingKeys, "scale", scales, motion.scales,
              motion.scale_curve);
    if (seen_.insert(channel.node).second)
      clip_.channels.push_back(std::move(channel));
    else
      ++repeated_;
  }

  template <class Value>
  void check_coefficients(const Value& value, const std::string& key) {
    if (!coefficients(value).allFinite()) file_.reject(place_ + ", " + key + " is not finite");
    if (coefficients(value).cwiseAbs().maxCoeff() > largest_number)
      file_.reject(place_ + ", " + key + " is absurd");
  }

  /// Returns: what the value was divided by.
  float check(const Vec3& value, const std::string& key) {
    check_coefficients(value, key);
    return 1;
  }
  float check(Quaternion& value, const std::string& key) {
    const double norm = to_eigen(value).cast<double>().norm();
    if (!is_finite(norm) || norm < 1e-6) file_.reject(place_ + ", " + key + " is no rotation");
    if (std::abs(norm - 1) > 1e-3) ++normalised_;
    value = quaternion(to_eigen(value).cast<double>().normalized().cast<float>());
    return static_cast<float>(norm);
  }

  /// A list of equal keys becomes one key.
  template <class Value, class AiKey>
  void read_part(const AiKey* source, unsigned size, const std::string& what, Interpolation interpolation,
                 std::vector<Key<Value>>& keys, Curve<Value>& curve) {
    if (size > 0 && source == nullptr) file_.reject(place_ + " has no " + what + " keys where it says so");
    const bool cubic = interpolation == Interpolation::cubic;
    keys.resize(cubic ? size / 3 : size);
    for (std::size_t k = 0; k < keys.size(); ++k) {
      const AiKey* const key = source + (cubic ? 3 * k + 1 : k);
      const std::string name = what + " key " + std::to_string(k);
      keys[k] = {seconds_of(*key, name), value_of(key->mValue)};
      const float divisor = check(keys[k].value, name);
      if (!cubic) continue;
      curve.tangents.push_back({tangent(key[-1], divisor, name), tangent(key[1], divisor, name)});
    }
    curve.interpolation = interpolation;
    const auto earlier = [](const Key<Value>& a, const Key<Value>& b) { return a.time < b.time; };
    if (!std::is_sorted(keys.begin(), keys.end(), earlier)) {
      ++unordered_;
      sort_keys(keys, curve.tangents);
    }
    if (keys.empty() || !is_constant(keys, curve)) return;
    keys.resize(1);
    curve = {};
  }

  template <class AiKey>
  float seconds_of(const AiKey& key, const std::string& name) {
    const double seconds = key.mTime / ticks_per_second_;
    if (!(std::abs(seconds) <= longest_clip))
      file_.reject(place_ + ", " + name + " is at " + shortest(seconds) + " s");
    first_ = std::min(first_, static_cast<float>(seconds));
    last_ = std::max(last_, static_cast<float>(seconds));
    return static_cast<float>(seconds);
  }

  template <class AiKey>
  auto tangent(const AiKey& key, float divisor, const std::string& name) {
    const auto value = quotient(value_of(key.mValue), divisor);
    check_coefficients(value, "tangent of " + name);
    return value;
  }

  /// A clip that starts before 0 is moved, as a pose's time counts from the start.
  void set_length() {
    const double declared = animation_.mDuration / ticks_per_second_;
    if (declared <= longest_clip) last_ = std::max(last_, static_cast<float>(declared));
    clip_.seconds = last_ - first_;
    if (first_ == 0) return;
    for (SourceChannel& channel : clip_.channels) {
      for (auto& key : channel.motion.positions) key.time -= first_;
      for (auto& key : channel.motion.rotations) key.time -= first_;
      for (auto& key : channel.motion.scales) key.time -= first_;
    }
  }

  void add_notes(std::vector<std::string>& notes) const {
    const std::string start = "clip '" + clip_.name + "': ";
    if (ticks_per_second_ != animation_.mTicksPerSecond)
      notes.push_back(start + "no time unit, taken as 1/25 s");
    if (repeated_ > 0)
      notes.push_back(start + count(repeated_, "channel") + " of a joint that has one already");
    if (unordered_ > 0) notes.push_back(start + count(unordered_, "list") + " of keys put in order of time");
    if (normalised_ > 0) notes.push_back(start + count(normalised_, "rotation") + " normalised");
    if (first_ < 0) notes.push_back(start + "starts before time 0 and was moved there");
  }
};

}  // namespace

std::vector<SourceClip> read_clips(const SceneFile& file, std::vector<std::string>& notes) {
  const aiScene& scene = *file.scene;
  if (scene.mNumAnimations > 0 && scene.mAnimations == nullptr)
    file.reject("the scene has no clips where it says so");
  std::vector<SourceClip> clips;
  for (unsigned a = 0; a < scene.mNumAnimations; ++a) {
    const aiAnimation* animation = scene.mAnimations[a];
    if (animation == nullptr) file.reject("clip " + std::to_string(a) + " is missing");
    std::string name = to_string(animation->mName);
    if (name.empty()) name = "clip " + std::to_string(a);
    clips.push_back(ClipReader(file, *animation, std::move(name)).read(notes));
  }
  return clips;
}

std::vector<Eigen::Vector3d> hull_of_positions(const Channel& channel) {
  const auto& keys = channel.positions;
  const auto& tangents = channel.position_curve.tangents;
  std::vector<Eigen::Vector3d> hull;
  hull.reserve(keys.size() + 2 * tangents.size());
  for (const auto& key : keys) hull.push_back(to_eigen(key.value).cast<double>());
  for (std::size_t k = 1; k < tangents.size(); ++k) {
    const double third = (static_cast<double>(keys[k].time) - static_cast<double>(keys[k - 1].time)) / 3;
    hull.push_back(hull[k - 1] + third * to_eigen(tangents[k - 1].out).cast<double>());
    hull.push_back(hull[k] - third * to_eigen(tangents[k].in).cast<double>());
  }
  return hull;
}

void add_own_clips(const SceneFile& file, const NodeList& nodes, Character& character, ImportReport& report) {
  std::unordered_map<std::string, std::uint32_t> joint_by_name;
  for (std::uint32_t j = 0; j < character.joints.size(); ++j)
    joint_by_name.try_emplace(character.joints[j].name, j);

  for (SourceClip& source : read_clips(file, report.notes)) {
    Clip clip{source.name, source.seconds, {}};
    std::size_t unknown = 0;
    for (SourceChannel& channel : source.channels) {
      const auto joint = joint_by_name.find(channel.node);
      note_if_shared(nodes, channel.node, report);
      if (joint != joint_by_name.end()) {
        channel.motion.joint = joint->second;
        clip.channels.push_back(std::move(channel.motion));
      } else if (!nodes.by_name.contains(channel.node)) {
        ++unknown;
      }
    }
    const std::string start = "clip '" + source.name + "': ";
    if (unknown > 0)
      report.notes.push_back(start + count(unknown, "channel") + " dropped for want of a node of that name");
    if (clip.channels.empty()) {
      report.notes.push_back(start + "dropped, as it moves nothing that carries vertices");
      continue;
    }
    report.clips.push_back({clip.name, clip.seconds, clip.channels.size(), source.channels.size()});
    character.clips.push_back(std::move(clip));
  }
}

}  // namespace bch::detail::importing
