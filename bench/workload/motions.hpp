// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <bch/body_set.hpp>
#include <bch/motion.hpp>

#include "bench/characters/characters.hpp"
#include "bench/characters/crowd.hpp"
#include "kernel/runtime/all_options.hpp"

namespace bch::bench {

/// Parts of clips are multiples of this: whole milliseconds that floats hold, so that those of a part that goes round are those of its first round.
constexpr double least_clip_seconds = 0.125;

/// Represents a clip, or the first part of it, played over and over, as one body over all its times.
struct AnimatedClip {
  const Character* character;
  std::uint32_t clip;
  double seconds;
  AnimatedShape shape;
};

/// Makes the bodies of the clips of a name, or of all where no character has one, on all threads. Clips of which animate() makes none, and
/// shorter ones than least_clip_seconds, are left out. The characters must outlive them.
/// Errors:  throws std::runtime_error where none is left.
std::vector<AnimatedClip> animated_clips(std::span<const cli::LoadedCharacter> characters,
                                         std::string_view name, double max_seconds);

/// Represents ten seconds of people who walk along arcs and play clips, and the pairs of them that come within a metre, having
/// begun farther apart.
class MotionScene {
 public:
  static constexpr double seconds = 10;
  static constexpr TimeInterval interval{0, seconds};

  /// Takes clips of spheres, which must outlive this.
  MotionScene(std::span<const AnimatedClip> clips, std::uint32_t pairs, std::uint64_t seed);

  std::span<const AnimatedClip> clips() const { return clips_; }
  std::span<const Motion> motions() const { return motions_; }
  /// Returns which clip a motion plays.
  std::uint32_t clip(std::uint32_t motion) const { return clip_[motion]; }
  /// Returns the pairs, and when each first touches: what first_contact() says.
  std::span<const Pair> pairs() const { return pairs_; }
  std::span<const double> contacts() const { return contacts_; }
  /// Returns the pairs that touch, or those that do not.
  std::vector<Pair> pairs(bool touching) const;

  /// Compares first contacts with the bodies at every millisecond before, by collide(): the first so many pairs.
  /// Errors:  throws std::runtime_error naming the pair, where one is later, or earlier by more than the tolerance.
  void check(std::uint32_t pairs) const;

 private:
  std::span<const AnimatedClip> clips_;
  std::vector<std::vector<PathKey>> paths_;
  std::vector<std::uint32_t> clip_;
  std::vector<Motion> motions_;
  std::vector<Pair> pairs_;
  std::vector<double> contacts_;
};

/// Samples the motions of a scene at even times, by the nearest of poses of their spheres that are built beforehand: what is
/// asked without first_contact().
class SampledMotions {
 public:
  /// Takes a scene, which must outlive this.
  SampledMotions(const MotionScene& scene, double samples_per_second, double poses_per_second);

  /// Returns the first sample at which two motions collide, or infinity. It asks collide() in batches of a tenth of a second.
  double first_contact(const Pair& pair) const;

 private:
  double samples_per_second_;
  std::uint32_t samples_;  ///< of a motion
  std::optional<BodySet> poses_;
  cli::Crowd all_;  ///< an agent a sample, motion by motion
};

}  // namespace bch::bench
