// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <bch/characters.hpp>

#include "kernel/recordings/footprints.hpp"
#include "kernel/recordings/walkers.hpp"

namespace bch::detail {

/// Represents a shape of a baked set, and its time in the clip.
struct BakedPose {
  float seconds;
  std::uint32_t shape;
};

/// Represents a clip of a character.
struct LibraryClip {
  std::string name;
  double seconds;        ///< length of a cycle
  double speed;          ///< walking speed in the clip at the character's own height, metres per second
  std::uint32_t phases;  ///< number of phases, such that half a phase moves no vertex by more than 1 cm
  std::vector<BakedPose> baked = {};  ///< for a baked set: the phases, by time
};

/// Represents a custom character for the people of a recording. It walks along +x; a character of a baked set
/// keeps the size and direction with which it was baked.
struct CharacterEntry {
  std::string name;
  Character character;             ///< empty if baked
  double height;                   ///< in its first walk, metres; 0 if baked
  std::vector<LibraryClip> clips;  ///< all clips of the character
  std::vector<std::uint32_t>
      walks;  ///< clips in which it walks straight ahead, by ascending speed; never empty
  std::vector<std::uint32_t>
      idles;  ///< clips in which it stands; if empty, a standing person stops in the slowest walk
  std::vector<std::string> assumptions;
};

/// Classifies the clips of a character by the foot on the ground. In a walk, that foot moves back under the
/// body at the body's speed, also if the character walks on the spot.
///
/// - walk: it mostly moves so in one direction, at 0.3 m/s or more - idle: it hardly moves, and something
/// else does - other clips, such as turns, and walks in another direction than most, are left out
///
/// Errors:  throws std::invalid_argument, naming the character, if no clip is a walk.
CharacterEntry character_entry(Character character, const std::string& name);

/// Sorts the walks of a character by ascending speed.
void sort_walks(CharacterEntry& member);

/// The custom characters of a recording, and a view of them.
using CharacterLibrary = std::vector<CharacterEntry>;
using CharacterLibraryView = std::span<const CharacterEntry>;

/// Returns the index of the character that a person gets. It depends only on the id and the number of
/// characters.
std::uint32_t member_by_id(std::int64_t id, CharacterLibraryView library);

/// Holds the character and clip, or the body, that rows of a recording name.
struct LibraryMotion {
  std::optional<std::uint32_t> member;  ///< the character; none: member_by_id()
  std::vector<std::uint32_t> clips;     ///< a clip for each character; empty: chosen by the speed
  PlanePolygons footprint = {};         ///< of a body that does not walk; otherwise empty
};

/// Finds the characters and clips, or the bodies, that rows of a recording name. The name of a character is
/// its file, with or without the extension; that of a clip comes from the file. Bodies are those of `own` and
/// of the library.
/// Errors:  throws TrajectoryError, naming the file, the line and the name, on an unknown name, on a clip
///          without a character that not every character has, and on a body that footprint_of() rejects.
std::vector<LibraryMotion> library_motions(std::span<const NamedMotion> named, CharacterLibraryView library,
                                           std::span<const Footprint> own = {});

/// Represents a clip of a character, and a phase of it.
struct LibraryPose {
  std::uint32_t member;  ///< of the library
  std::uint32_t clip;    ///< of the character
  std::uint32_t phase;
  float seconds;        ///< of the phase, in the clip
  float exact_seconds;  ///< the time before rounding to a phase
};

/// Returns the pose of a walker: the one that the row names; or the walk with the nearest speed, advanced by
/// the distance walked; or an idle clip while the walker stands. `motions`: from library_motions(). `coarse`:
/// divides the number of phases.
LibraryPose library_pose(CharacterLibraryView library, std::span<const LibraryMotion> motions,
                         const Walker& walker, std::uint32_t coarse);

/// Returns a character scaled to a stature in metres.
Character scaled(const CharacterEntry& member, double stature);

}  // namespace bch::detail
