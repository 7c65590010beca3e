// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <bch/motion.hpp>
#include <bch/obstacles.hpp>
#include <bch/shapes.hpp>

namespace bch::bench {

/// Represents a clip that people play on their way: the body as it moves, seen from above.
struct PlacedClip {
  std::string character, name;
  double speed;    ///< metres a second along +x; 0 where the clip does not walk straight on
  double seconds;  ///< of the clip
  double stature;  ///< metres, as the character walks; 0 where it does not
  AnimatedShape body;
};

/// Holds the keys of a path that is given, at least two; they begin at time 0.
struct GivenPath {
  std::int64_t id;
  std::vector<PathKey> keys;
};

/// Holds what is filled, and with what.
struct PlacingOptions {
  double width = 10, depth = 10;  ///< metres
  double seconds = 10;            ///< how long everybody is on his way
  std::uint32_t tries = 500;      ///< so many candidates in a row that have no room end the search
  std::uint64_t seed = 1;
  const ObstacleSet* obstacles = nullptr;  ///< where people must not go; or none
  std::span<const GivenPath> paths = {};   ///< of which each is tried once at most; none: arcs are drawn
};

/// Represents a person who has room: on a given path, or on an arc from inside the area to inside the area, at the clip's speed.
struct PlacedPerson {
  std::int64_t id;  ///< of the given path, or which candidate it was
  std::uint32_t clip;
  double clip_begin;  ///< the time at which the clip is at its beginning, at most 0
  std::vector<PathKey> path;
};

/// Holds the people who found room.
struct Placement {
  std::vector<PlacedPerson> people;
  std::uint64_t candidates = 0;  ///< who were tried
};

/// Fills an area by rejection sampling: candidates of random clips, phases and paths come in, and who
/// has contact with nobody and no obstacle stays.
/// Errors:  throws std::invalid_argument where no arc of a clip fits into the area.
Placement place(std::span<const PlacedClip> clips, const PlacingOptions& options);

/// Returns the keys, from time 0 on, of somebody who goes on at even speed and turns evenly, in metres and radians a second.
std::vector<PathKey> arc(const PathKey& begin, double speed, double turn, double seconds);

/// Returns where a person is at a time: between two keys as Motion says.
PathKey at(std::span<const PathKey> path, double seconds);

}  // namespace bch::bench
