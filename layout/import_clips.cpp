// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import_clips.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "layout/shortest.hpp"

namespace bch::import_detail {
namespace {

constexpr double default_ticks_per_second = 25;  // what a reader is to assume where a file is silent
constexpr double longest_clip = 1e6;             // seconds

Eigen::Vector3f to_eigen(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}
Eigen::Quaternionf to_eigen(const aiQuaternion& q) {
  return {q.w, q.x, q.y, q.z};
}

bool same(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return a == b;
}
bool same(const Eigen::Quaternionf& a, const Eigen::Quaternionf& b) {
  return a.coeffs() == b.coeffs();
}

/// Reads one animation.
class ClipReader {
 public:
  ClipReader(const SceneFile& file, const aiAnimation& animation, std::string name)
      : file_(file), animation_(animation), ticks_per_second_(animation.mTicksPerSecond) {
    clip_.name = std::move(name);
    if (!(std::isfinite(ticks_per_second_) && ticks_per_second_ > 0))
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
    channel.motion.positions =
        read_keys<Eigen::Vector3f>(source->mPositionKeys, source->mNumPositionKeys, "position");
    channel.motion.rotations =
        read_keys<Eigen::Quaternionf>(source->mRotationKeys, source->mNumRotationKeys, "rotation");
    channel.motion.scales =
        read_keys<Eigen::Vector3f>(source->mScalingKeys, source->mNumScalingKeys, "scale");
    if (seen_.insert(channel.node).second)
      clip_.channels.push_back(std::move(channel));
    else
      ++repeated_;
  }

  void check(Eigen::Vector3f& value, const std::string& key) {
    if (!value.allFinite()) file_.reject(place_ + ", " + key + " is not finite");
    if (value.cwiseAbs().maxCoeff() > largest_number) file_.reject(place_ + ", " + key + " is absurd");
  }

  void check(Eigen::Quaternionf& value, const std::string& key) {
    const double norm = value.cast<double>().norm();
    if (!std::isfinite(norm) || norm < 1e-6) file_.reject(place_ + ", " + key + " is no rotation");
    if (std::abs(norm - 1) > 1e-3) ++normalised_;
    value = value.cast<double>().normalized().cast<float>();
  }

  /// A list of equal keys becomes one key.
  template <class Value, class AiKey>
  std::vector<Key<Value>> read_keys(const AiKey* source, unsigned size, const std::string& what) {
    if (size > 0 && source == nullptr) file_.reject(place_ + " has no " + what + " keys where it says so");
    std::vector<Key<Value>> keys(size);
    for (unsigned k = 0; k < size; ++k) {
      const double seconds = source[k].mTime / ticks_per_second_;
      if (!(std::abs(seconds) <= longest_clip))
        file_.reject(place_ + ", " + what + " key " + std::to_string(k) + " is at " + shortest(seconds) +
                     " s");
      keys[k] = {static_cast<float>(seconds), to_eigen(source[k].mValue)};
      check(keys[k].value, what + " key " + std::to_string(k));
      first_ = std::min(first_, keys[k].time);
      last_ = std::max(last_, keys[k].time);
    }
    const auto earlier = [](const Key<Value>& a, const Key<Value>& b) { return a.time < b.time; };
    if (!std::is_sorted(keys.begin(), keys.end(), earlier)) {
      ++unordered_;
      std::stable_sort(keys.begin(), keys.end(), earlier);
    }
    const auto like_first = [&](const Key<Value>& key) { return same(key.value, keys.front().value); };
    if (!keys.empty() && std::all_of(keys.begin(), keys.end(), like_first)) keys.resize(1);
    return keys;
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

}  // namespace bch::import_detail
