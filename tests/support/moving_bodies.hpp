// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "tests/support/scenes.hpp"

// Bodies that move, and motions of theirs, with a definition of contact that samples. Random bodies have discs that an AnimatedShape
// keeps as they are.

namespace bch::test {

/// The time of a contact that never comes.
inline constexpr double never = std::numeric_limits<double>::infinity();

/// Returns a body whose discs stand round one that swings its limbs: chunks with different discs, at uneven keys.
AnimatedDiscs swinging_body(Random& random, std::uint32_t chunks = 2, std::uint32_t discs = 24);

/// Returns discs that move each for itself.
AnimatedDiscs loose_discs(Random& random, std::uint32_t discs = 5);

/// Returns a body whose discs are spheres at heights from 0 to a top below 1.9 m, which change by centimetres from key to key.
AnimatedDiscs in_space(Random& random, AnimatedDiscs body, double top);

/// Returns one disc that stands still for a second.
AnimatedDiscs still_disc(float radius, float x = 0, float y = 0);

/// A motion that owns what it is made of.
struct MotionCase {
  AnimatedDiscs discs;
  AnimatedShape shape;
  std::vector<PathKey> path;
  double clip_begin;

  MotionCase(AnimatedDiscs moving, std::vector<PathKey> keys, double begin = 0)
      : discs(std::move(moving)), shape(discs), path(std::move(keys)), clip_begin(begin) {}
  Motion motion() const { return {&shape, path, clip_begin}; }
};

/// Returns a motion of a random body that comes past the origin in a few seconds.
MotionCase random_motion(Random& random);
/// Likewise of a given body.
MotionCase random_motion(Random& random, AnimatedDiscs body);

/// Returns the first contact of two motions.
inline double contact_of(const MotionCase& a, const MotionCase& b, const TimeInterval& interval,
                         double tolerance = 0.005) {
  const std::vector<Motion> motions = {a.motion(), b.motion()};
  double time = 0;
  first_contact(motions, std::vector<Pair>{{0, 1}}, interval, {&time, 1}, tolerance);
  return time;
}
/// Returns the first contact of a motion with obstacles.
inline double contact_of(const MotionCase& motion, const ObstacleSet& obstacles, const TimeInterval& interval,
                         double tolerance = 0.005) {
  double time = 0;
  first_contact(std::vector<Motion>{motion.motion()}, obstacles, interval, {&time, 1}, tolerance);
  return time;
}

struct WorldDisc {
  double x, y, radius;
  double z = 0;  ///< of spheres
};
/// Returns where the discs of a motion are at a time.
std::vector<WorldDisc> placed_at(const MotionCase& motion, double time);

/// Returns the gap of the nearest discs of two motions at a time, by all pairs of them; in space if both are of spheres.
double gap_at(const MotionCase& a, const MotionCase& b, double seconds);

}  // namespace bch::test
