// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <cstdint>
#include <span>
#include <vector>

#include <bch/broad_phase.hpp>
#include <bch/dynamic_shape_set.hpp>
#include <bch/pose_shape.hpp>
#include <bch/scene_plan.hpp>

#include "bench/characters/crowd.hpp"

namespace bch::bench {

/// Holds the seconds of a frame's parts, wall clock.
struct FrameTime {
  double shapes = 0, pairs = 0, answers = 0;
};

/// Represents a crowd in which every character is posed anew in every frame: an example of how a simulator that does
/// so uses the library. Each agent has a shape of its own, which is skinned, outlined, divided and put into the set's
/// arrays while other threads do so with others.
class LiveCrowd {
 public:
  /// Makes a crowd whose agents walk straight on, at one a square metre, in clips chosen at random, to a cut
  /// depth. The characters must outlive this.
  LiveCrowd(std::span<const Character> characters, std::uint32_t agents, std::uint32_t depth);

  /// Computes the next frame, `seconds` later. Runs in the caller's TBB arena.
  FrameTime step(double seconds);

  /// Returns the pairs of the last frame; hits() returns their answers.
  std::span<const Pair> pairs() const { return pairs_; }
  std::span<const std::uint8_t> hits() const { return hits_; }
  /// Returns the answers for a set that is built from the same poses, with everything that a set can have.
  std::vector<std::uint8_t> hits_of_a_new_set() const;

 private:
  /// Holds memory that a thread keeps from shape to shape.
  struct Workshop {
    std::vector<PoseShaper> shapers;
    PreparedShape prepared;

    Workshop(std::span<const Character> characters, const ShapeSetPlan& plan);
    const PreparedShape& make(const ShapeSource& source, std::uint32_t shape);
  };

  ShapeSet first_shapes() const;
  void walk(double seconds);
  void build_shapes();
  Agents agents() const { return crowd_.agents(); }

  std::span<const Character> characters_;
  ShapeSetPlan plan_;
  cli::Crowd crowd_;
  std::vector<ShapeSource> sources_;  ///< one an agent, which is one a shape
  DynamicShapeSet shapes_;
  tbb::enumerable_thread_specific<Workshop> workshops_;
  std::vector<std::uint8_t> outgrown_;  ///< per shape: it needs a larger place
  BroadPhase broad_phase_;
  std::span<const Pair> pairs_;
  std::vector<std::uint8_t> hits_;
};

}  // namespace bch::bench
