// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_set>
#include <vector>

#include "kernel/broad_phase/broad_phase.hpp"
#include "kernel/recordings/check.hpp"
#include "kernel/recordings/frame_block.hpp"
#include "kernel/recordings/frame_run.hpp"
#include "kernel/recordings/walker_bodies.hpp"
#include "layout/base/mixed_hash.hpp"

namespace bch::detail {

/// Counts the people of a prediction who collide with others as these truly went: Col-II of TrajNet++ (Kothari,
/// Kreiss, Alahi, IEEE Trans. ITS 2022). People collide in a frame that both recordings have, or halfway from
/// such a frame to the next, in the poses and headings of the earlier one.
class TruthCollisions {
 public:
  /// Keeps references to a recording of what happened, whose people have the ids of the prediction, and which
  /// has the same frames; and to what `options`, those of the check, refer to. `predicted`: of the prediction.
  /// Errors:  throws TrajectoryError where the frame rates differ, or like check().
  TruthCollisions(TrajectoryReader& truth, const TrajectoryInfo& predicted, const CheckOptions& options);

  /// Takes the next frame of the prediction. Errors: throws TrajectoryError on what the reader rejects;
  /// TooManyPairs.
  void add(const CheckedFrame& frame);
  /// Return how many people collide at any time, as bodies and as discs of radius measured_disc.
  std::uint64_t colliding() const noexcept { return colliding_.size(); }
  std::uint64_t disc_colliding() const noexcept { return disc_colliding_.size(); }
  /// Returns how many frames both recordings had.
  std::uint64_t frames() const noexcept { return frames_; }

 private:
  struct Person {
    std::int64_t id;
    double x, y, heading;
    WalkerPose pose;
  };
  /// Holds the people of a frame, by ascending id; of the truth nobody where it lacks the frame.
  struct People {
    std::vector<Person> predicted, true_ones;
  };

  void read_truth(std::int64_t frame);
  void read_next();
  static std::vector<Person> halfway(std::span<const Person> from, std::span<const Person> to);
  void find(std::span<const Person> predicted, std::span<const Person> others);
  void find_discs(std::span<const Person> predicted, std::vector<Person> others);
  void find_overlaps(const RunBodies& bodies, std::span<const Person> all, std::size_t predicted);

  const CheckOptions options_;
  const std::vector<LibraryMotion> true_motions_;  ///< those that rows of the truth name
  const std::vector<LibraryMotion> motions_;       ///< of the prediction, then those
  WalkerReader truth_;
  FrameBlock block_, next_block_;  ///< whose first frame is that which was read last
  bool at_end_ = false, is_over_ = false;
  FrameRun run_;
  WalkerShapes shapes_;
  std::optional<WalkerBodies> bodies_;
  BroadPhase phase_;
  People last_, now_;
  std::uint64_t frames_ = 0;
  std::unordered_set<std::uint64_t, MixedHash> colliding_, disc_colliding_;
};

}  // namespace bch::detail
