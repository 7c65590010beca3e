// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/baked_library.hpp"

#include <algorithm>
#include <map>
#include <sstream>
#include <stdexcept>

namespace bch::detail {
namespace {

constexpr std::size_t max_poses = 65'535, max_baked_clips = 65'535;

using ClipPoses = std::map<std::uint32_t, std::vector<BakedPose>>;  // by the clip's name

/// The poses of each character and clip, by their names' numbers.
std::map<std::uint32_t, ClipPoses> poses_of(const ShapeOrigins& origins) {
  std::map<std::uint32_t, ClipPoses> poses;
  for (std::uint32_t i = 0; i < origins.origins.size(); ++i) {
    const ShapeOrigin& origin = origins.origins[i];
    poses[origin.character][origin.clip].push_back({origin.seconds, i});
  }
  return poses;
}

/// A clip, whose end nobody knows: it is taken for as far behind the last pose as poses are apart.
LibraryClip clip_of(const std::string& name, std::vector<BakedPose> poses) {
  std::stable_sort(poses.begin(), poses.end(),
                   [](const BakedPose& a, const BakedPose& b) { return a.seconds < b.seconds; });
  const auto count = static_cast<double>(poses.size());
  const double way = static_cast<double>(poses.back().seconds - poses.front().seconds);
  return {name, poses.size() == 1 ? 0 : way * count / (count - 1), 0,
          static_cast<std::uint32_t>(poses.size()), std::move(poses)};
}

/// Says what clips are for. A clip's speed is negative where none was told.
std::string use_of(const CharacterEntry& member, std::span<const double> speeds) {
  std::ostringstream walks, stands, others;
  for (std::size_t k = 0; k < speeds.size(); ++k) {
    const std::string& name = member.clips[k].name;
    if (speeds[k] > 0)
      walks << (walks.tellp() > 0 ? ", " : "") << name << " at " << speeds[k] << " m/s";
    else
      (speeds[k] == 0 ? stands : others) << ", " << name;
  }
  std::ostringstream text;
  text << member.name << ": walks in " << walks.str();
  if (stands.tellp() > 0) text << "; stands in " << stands.str().substr(2);
  if (others.tellp() > 0)
    text << "; without a speed, and only where rows name them, " << others.str().substr(2);
  return text.str();
}

/// Divides the clips of a member into those that walk, stand and neither.
void take_speeds(CharacterEntry& member, const std::string& file, std::span<const ClipSpeed> speeds) {
  std::vector<double> told(member.clips.size(), -1);
  std::string all;
  for (std::uint32_t k = 0; k < told.size(); ++k) {
    LibraryClip& clip = member.clips[k];
    all += (k == 0 ? "" : ", ") + clip.name;
    for (const ClipSpeed& speed : speeds)
      if (speed.clip == clip.name) told[k] = speed.speed;
    clip.speed = std::max(0.0, told[k]);
    if (told[k] > 0) member.walks.push_back(k);
    if (told[k] == 0) member.idles.push_back(k);
  }
  if (member.walks.empty())
    throw std::invalid_argument(file +
                                ": does not say how fast people walk in its clips: --clip-speed has to, as " +
                                "walk=1.3; those of " + member.name + " are " + all);
  sort_walks(member);
  member.assumptions.push_back(use_of(member, told));
}

void validate(const BakedShapes& baked, const std::string& file) {
  if (baked.origins.origins.empty())
    throw std::invalid_argument(file + ": does not say which clips and times its shapes show");
}

void require_all_there(const CharacterLibrary& library, const std::string& file,
                       std::span<const ClipSpeed> speeds) {
  for (const ClipSpeed& speed : speeds) {
    const bool is_there = std::any_of(library.begin(), library.end(), [&](const CharacterEntry& member) {
      return std::any_of(member.clips.begin(), member.clips.end(),
                         [&](const LibraryClip& clip) { return clip.name == speed.clip; });
    });
    if (!is_there) throw std::invalid_argument(file + ": has no clip called " + speed.clip);
  }
}

/// The longest time between two poses that follow each other in a clip that walks or stands.
double longest_step(const CharacterLibrary& library) {
  double longest = 0;
  for (const CharacterEntry& member : library)
    for (const LibraryClip& clip : member.clips)
      for (std::size_t i = 1; i < clip.baked.size(); ++i)
        longest = std::max(longest, static_cast<double>(clip.baked[i].seconds - clip.baked[i - 1].seconds));
  return longest;
}

}  // namespace

CharacterLibrary baked_library(const BakedShapes& baked, const std::string& file,
                               std::span<const ClipSpeed> speeds) {
  validate(baked, file);
  const std::vector<std::string>& names = baked.origins.names;
  CharacterLibrary library;
  for (auto& [character, clips] : poses_of(baked.origins)) {
    CharacterEntry& member = library.emplace_back(CharacterEntry{names[character], {}, 0, {}, {}, {}, {}});
    for (auto& [clip, poses] : clips)
      member.clips.push_back(clip_of(clip == ShapeOrigin::no_clip ? "rest pose" : names[clip], poses));
    const bool fits = member.clips.size() <= max_baked_clips &&
                      std::all_of(member.clips.begin(), member.clips.end(),
                                  [](const LibraryClip& clip) { return clip.baked.size() <= max_poses; });
    if (!fits)
      throw std::invalid_argument(file + ": has more than 65535 clips of a character, or poses of a clip");
  }
  require_all_there(library, file, speeds);
  for (CharacterEntry& member : library) take_speeds(member, file, speeds);
  std::ostringstream text;
  text.precision(3);
  text << file << ": people are as tall as they were baked, and in the pose nearest in time, at most "
       << 500 * longest_step(library) << " ms away";
  library[0].assumptions.push_back(text.str());
  return library;
}

}  // namespace bch::detail
