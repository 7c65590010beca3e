// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include <bch/time_of_impact.hpp>

#include "layout/shape_set/animated_tree.hpp"

namespace bch::detail {

/// What a search wants to know of a motion beforehand.
struct MotionFacts {
  const AnimatedTree* tree;
  std::span<const PathKey> path;
  double clip_begin;
  double path_speed = 0;  ///< the most in a second, metres
  double speed = 0;       ///< of any of its discs' centres, and a radius
  double farthest = 0;    ///< the largest coordinate of a key

  /// Takes a motion that is valid.
  explicit MotionFacts(const Motion& motion);
};

/// A motion at times that ascend: which keys of its path and of its clip a time lies between.
class MovingBody {
 public:
  explicit MovingBody(const MotionFacts& facts) : facts_(&facts) {}

  /// Goes on to a time, and returns until when the path goes straight on and turns evenly from there: after that time, or infinite.
  double path_end(double time) noexcept;
  /// Likewise until when discs move straight on.
  double clip_end(double time) noexcept;

  /// Returns where the body is until path_end().
  PathKey pose(double time) const noexcept;
  /// Returns until when the window of keys goes on in which it is now.
  double window_end(unsigned level) const noexcept;
  /// Returns the first and the last key of that window, and which share of the time between has gone by at a time within it.
  std::pair<std::size_t, std::size_t> window(unsigned level) const noexcept {
    return {chunk().window_begin(key_, level), chunk().window_end(key_, level)};
  }
  double share(double time, unsigned level) const noexcept;
  const AnimatedTreeChunk& chunk() const noexcept { return tree().chunks[chunk_]; }
  /// Counts the chunks that began. Discs of one have nothing to do with those of another.
  std::uint32_t chunks_begun() const noexcept { return chunks_begun_; }

 private:
  const AnimatedTree& tree() const noexcept { return *facts_->tree; }
  void find_key(double time) noexcept;
  void next_key() noexcept;
  double time_of(std::size_t key) const noexcept { return chunk().times[key] + shift_; }

  const MotionFacts* facts_;
  std::size_t next_on_path_ = 0;  ///< the first key of the path after the time
  std::size_t chunk_ = 0, key_ = 0;
  double shift_ = 0;  ///< of the clip's times to those of the motion
  double clip_end_ = -std::numeric_limits<double>::infinity();
  std::uint32_t chunks_begun_ = 0;
};

}  // namespace bch::detail
