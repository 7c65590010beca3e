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
struct CastClip {
  std::string name;
  double seconds;        ///< from its beginning to where it begins again
  double speed;          ///< at which the character walks in it, at its own height, metres a second
  std::uint32_t phases;  ///< so many that half a step between two moves no vertex by more than a centimetre
  std::vector<BakedPose> baked = {};  ///< of a member of a baked set, by time: its phases
};

/// Represents a custom character as the people of a recording have it: it walks along +x, except for those of a baked set, which have
/// the size and the direction that they were baked with.
struct CharacterEntry {
  std::string name;
  Character character;               ///< empty where it is baked
  double height;                     ///< in its first walk, metres; 0 where it is baked
  std::vector<CastClip> clips;       ///< of the character
  std::vector<std::uint32_t> walks;  ///< those in which it walks straight on, by ascending speed; never empty
  std::vector<std::uint32_t>
      idles;  ///< in which it stands; may be empty: who stands then stops in the slowest walk
  std::vector<std::string> assumptions;
};

/// Finds which clips of a character walk, how fast and where to, by the foot on the ground: that goes back under the body
/// as fast as the body goes forward, also in a clip that walks on the spot. A clip in which it mostly does so in one direction,
/// at 0.3 m/s or more, is a walk; one in which it hardly moves and something else does is an idle; the others, which turn, are
/// left out, and so are walks of another direction than most.
/// Errors:  throws std::invalid_argument, naming the character, where no clip is a walk.
CharacterEntry character_entry(Character character, const std::string& name);

/// Sorts the walks of a member by ascending speed.
void sort_walks(CharacterEntry& member);

/// Holds the custom characters in a recording, and a view of them, which they outlive.
using Cast = std::vector<CharacterEntry>;
using CastView = std::span<const CharacterEntry>;

/// Returns which of them a person has, by the id: the same in every run.
std::uint32_t member_by_id(std::int64_t id, CastView cast);

/// Holds the body and the clip that rows of a recording name.
struct CastMotion {
  std::optional<std::uint32_t> member;  ///< else one by the id
  std::vector<std::uint32_t> clips;     ///< of each member; empty: by the speed
  PlanePolygons footprint = {};         ///< of a body that does not walk, in place of both; else empty
};

/// Finds the characters and clips, or the bodies, that the rows of a recording name. A character has the name of its file, with or
/// without the extension, and a clip the name that the file gives it. Bodies are `own` ones or those of the library.
/// Errors:  throws TrajectoryError, naming the file, the line and the name, on what is not there, on a clip that a row names without a
///          character and that one of them does not have, and on a body that footprint_of() rejects.
std::vector<CastMotion> cast_motions(std::span<const NamedMotion> named, CastView cast,
                                     std::span<const Footprint> own = {});

/// Represents a clip of a character, and a phase of it.
struct CastPose {
  std::uint32_t member;  ///< of the cast
  std::uint32_t clip;    ///< of the character
  std::uint32_t phase;
  float seconds;        ///< of the phase, in the clip
  float exact_seconds;  ///< of the walker, before he is rounded to a phase
};

/// Returns how a walker moves: as his row says, else in the walk of the nearest speed, as far in it as he has walked,
/// or in an idle while he stands. `motions`: what cast_motions() found. `coarse`: divides the number of phases.
CastPose cast_pose(CastView cast, std::span<const CastMotion> motions, const Walker& walker,
                   std::uint32_t coarse);

/// Returns a character of a stature in metres.
Character scaled(const CharacterEntry& member, double stature);

}  // namespace bch::detail
