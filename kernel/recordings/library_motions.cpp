// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>

#include "kernel/recordings/character_library.hpp"
#include "layout/recordings/shown.hpp"

namespace bch::detail {
namespace {

using trajectory::shown;

[[noreturn]] void reject(const NamedMotion& motion, const std::string& reason) {
  throw TrajectoryError(motion.place + ": " + reason);
}

template <class Named>
std::string names_of(const Named& all) {
  std::string names;
  for (const auto& each : all) names += (names.empty() ? "" : ", ") + shown(each.name);
  return names;
}

bool is_called(const CharacterEntry& member, const std::string& name) {
  return member.name == name || member.name.substr(0, member.name.rfind('.')) == name;
}

std::optional<std::uint32_t> member_of(const NamedMotion& motion, CharacterLibraryView library) {
  if (motion.character.empty()) return std::nullopt;
  const auto has_name = [&](const CharacterEntry& member) { return is_called(member, motion.character); };
  const auto found = std::find_if(library.begin(), library.end(), has_name);
  if (found == library.end())
    reject(motion, "character " + shown(motion.character) + " is none of " + names_of(library));
  if (std::find_if(found + 1, library.end(), has_name) != library.end())
    reject(motion, "character " + shown(motion.character) + " may be several of " + names_of(library));
  return static_cast<std::uint32_t>(found - library.begin());
}

std::uint32_t clip_of(const NamedMotion& motion, const CharacterEntry& member) {
  const auto found = std::find_if(member.clips.begin(), member.clips.end(),
                                  [&](const LibraryClip& clip) { return clip.name == motion.clip; });
  if (found == member.clips.end())
    reject(motion, "clip " + shown(motion.clip) + " is not in " + shown(member.name) + ", which has " +
                       names_of(member.clips));
  return static_cast<std::uint32_t>(found - member.clips.begin());
}

LibraryMotion body_motion(const NamedMotion& named, std::span<const Footprint> own) try {
  return {std::nullopt, {}, footprint_of(named.body, named.length, named.width, own)};
} catch (const std::invalid_argument& error) {
  reject(named, error.what());
}

LibraryMotion library_motion(const NamedMotion& named, CharacterLibraryView library) {
  if (library.empty())
    reject(named,
           (named.character.empty() ? "clip " + shown(named.clip) : "character " + shown(named.character)) +
               " needs a file that has it: --character has to name it");
  LibraryMotion motion{member_of(named, library), {}, {}};
  if (named.clip.empty()) return motion;
  for (std::uint32_t k = 0; k < library.size(); ++k)
    motion.clips.push_back(motion.member && *motion.member != k ? 0 : clip_of(named, library[k]));
  return motion;
}

}  // namespace

std::vector<LibraryMotion> library_motions(std::span<const NamedMotion> named, CharacterLibraryView library,
                                           std::span<const Footprint> own) {
  std::vector<LibraryMotion> motions;
  for (const NamedMotion& motion : named)
    motions.push_back(motion.body.empty() ? library_motion(motion, library) : body_motion(motion, own));
  return motions;
}

}  // namespace bch::detail
