// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include <bch/motion.hpp>

#include "layout/shape_set/animated_tree.hpp"

namespace bch::detail {

/// Factors of the errors of positions, which ContactSearch derives. time_rounding is multiplied by a speed
/// and a time, position_rounding by a coordinate, and root_rounding by an extent.
constexpr double time_rounding = 0x1p-48, position_rounding = 0x1p-48, root_rounding = 0x1p-20;

/// Holds the properties of a motion that a search needs.
struct MotionFacts {
  const AnimatedTree* tree;
  std::span<const PathKey> path;
  double clip_begin;
  double path_speed = 0;  ///< the largest, seen from above, metres per second
  double farthest = 0;    ///< the largest coordinate of a key

  /// The motion must be valid.
  explicit MotionFacts(const Motion& motion);
};

/// Represents a motion at ascending times: the keys of its path and of its clip around the current time.
class MovingBody {
 public:
  explicit MovingBody(const MotionFacts& facts) : facts_(&facts) {}

  /// Advances to a time. Returns the time of the next key of the path, or infinity. Motion and rotation are
  /// linear until then.
  double path_end(double time) noexcept;
  /// Returns the time until which discs move along straight lines: the next key of the clip, or infinity.
  double clip_end(double time) noexcept;

  /// Returns the period of its discs from a time on: 0 if they stand still, infinity if they do not repeat.
  double period(double time) noexcept;

  /// Returns a bound on the displacement of a disc by rounding of times. It holds from the time at which
  /// path_end() was last called until the time that path_end() returned.
  double time_slack(double time) const noexcept;
  /// Returns the position and heading at a time before path_end().
  PathKey pose(double time) const noexcept;
  /// Returns the last key of the clip before the current time. fraction() is the fraction, at a time, of the
  /// interval from this key to the next.
  std::size_t key() const noexcept { return key_; }
  double fraction(double time) const noexcept;
  /// Returns the hull over the current window at a level. A window is 2^level successive chunks of the clip, among
  /// them the current one; a chunk (AnimatedTreeChunk) is a part of the clip in which all discs have the same keys,
  /// two or more. hull_end() is the end of that window, and hull_fraction() the fraction of it at a time.
  const HullInterval& hull(unsigned level) const noexcept {
    return tree().hulls.levels[level][chunk_ >> level];
  }
  /// Returns the hulls of the bands of a body of spheres over that window.
  const HullBands& bands(unsigned level) const noexcept { return tree().hulls.bands[level][chunk_ >> level]; }
  double hull_end(unsigned level) const noexcept;
  double hull_fraction(double time, unsigned level) const noexcept;
  const AnimatedTree& tree() const noexcept { return *facts_->tree; }
  const AnimatedTreeChunk& chunk() const noexcept { return tree().chunks[chunk_]; }
  /// Returns how many chunks have begun. The number changes when the discs do, because each chunk has its own.
  std::uint32_t chunks_begun() const noexcept { return chunks_begun_; }

 private:
  void find_key(double time) noexcept;
  void next_key() noexcept;
  void begin_cycle(double cycle) noexcept;
  double time_of(std::size_t key) const noexcept { return chunk().times[key] + shift_; }

  const MotionFacts* facts_;
  std::size_t next_on_path_ = 0;  ///< the first key of the path after the current time
  std::size_t chunk_ = 0, key_ = 0;
  double cycle_ = 0;              ///< of a clip that loops
  double shift_ = 0;              ///< of the clip's times to those of the motion
  bool is_before_begin_ = false;  ///< the clip has not begun: the body stands still
  double clip_end_ = -std::numeric_limits<double>::infinity();
  std::uint32_t chunks_begun_ = 0;
};

}  // namespace bch::detail
