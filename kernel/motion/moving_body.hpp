// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include <bch/motion.hpp>

#include "layout/shape_set/animated_tree.hpp"

namespace bch::detail {

/// Bound the errors of positions for each metre a second and second, metre of a coordinate, and metre of the reaches; see ContactSearch.
constexpr double time_rounding = 0x1p-48, position_rounding = 0x1p-48, root_rounding = 0x1p-20;

/// Holds what a search wants to know of a motion beforehand.
struct MotionFacts {
  const AnimatedTree* tree;
  std::span<const PathKey> path;
  double clip_begin;
  double path_speed = 0;  ///< the most in a second, as seen from above, metres
  double farthest = 0;    ///< the largest coordinate of a key

  /// Takes a motion that is valid.
  explicit MotionFacts(const Motion& motion);
};

/// Represents a motion at times that ascend: which keys of its path and of its clip a time lies between.
class MovingBody {
 public:
  explicit MovingBody(const MotionFacts& facts) : facts_(&facts) {}

  /// Goes on to a time, and returns until when the path goes straight on and turns evenly from there: after that time, or infinite.
  double path_end(double time) noexcept;
  /// Returns until when discs move straight on.
  double clip_end(double time) noexcept;

  /// Returns after how long its discs repeat for good what they do from a time on: 0 where they stand still, infinite where they do not.
  double period(double time) noexcept;

  /// Returns by how much rounding of times moves a disc until path_end(), at most, from the time on for which that was called.
  double time_slack(double time) const noexcept;
  /// Returns where the body is until path_end().
  PathKey pose(double time) const noexcept;
  /// Returns the keys between which it is now: the first one, and which fraction of the time to the next has gone by at a time.
  std::size_t key() const noexcept { return key_; }
  double fraction(double time) const noexcept;
  /// Returns its hull through the window of chunks in which it is now, until when that goes on, and the fraction of it that has gone by.
  const HullWindow& hull(unsigned level) const noexcept {
    return tree().hulls.levels[level][chunk_ >> level];
  }
  /// Likewise, of a body of spheres: the hulls of its bands.
  const HullBands& bands(unsigned level) const noexcept { return tree().hulls.bands[level][chunk_ >> level]; }
  double hull_end(unsigned level) const noexcept;
  double hull_fraction(double time, unsigned level) const noexcept;
  const AnimatedTree& tree() const noexcept { return *facts_->tree; }
  const AnimatedTreeChunk& chunk() const noexcept { return tree().chunks[chunk_]; }
  /// Counts the chunks that began. Discs of one have nothing to do with those of another.
  std::uint32_t chunks_begun() const noexcept { return chunks_begun_; }

 private:
  void find_key(double time) noexcept;
  void next_key() noexcept;
  void begin_cycle(double cycle) noexcept;
  double time_of(std::size_t key) const noexcept { return chunk().times[key] + shift_; }

  const MotionFacts* facts_;
  std::size_t next_on_path_ = 0;  ///< the first key of the path after the time
  std::size_t chunk_ = 0, key_ = 0;
  double cycle_ = 0;              ///< of a clip that loops
  double shift_ = 0;              ///< of the clip's times to those of the motion
  bool is_before_begin_ = false;  ///< for its beginning, until which it stands
  double clip_end_ = -std::numeric_limits<double>::infinity();
  std::uint32_t chunks_begun_ = 0;
};

}  // namespace bch::detail
