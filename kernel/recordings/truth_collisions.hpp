// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <unordered_set>
#include <vector>

#include "kernel/recordings/check.hpp"
#include "layout/base/mixed_hash.hpp"

namespace bch::detail {

/// Counts the people of a prediction whose discs collide with those of others as these truly went: Col-II of TrajNet++ (Kothari, Kreiss,
/// Alahi, IEEE Trans. ITS 2022). Discs collide in a frame that both recordings have, or halfway from such a frame to the next.
class TruthCollisions {
 public:
  /// Refers to a recording of what happened, whose people have the ids of the prediction, and which has the same frames.
  /// Errors:  throws TrajectoryError where its frame rate is not that of the prediction.
  TruthCollisions(TrajectoryReader& truth, double fps);

  /// Takes the next frame of the prediction. Errors: throws TrajectoryError on what the reader rejects.
  void add(const CheckedFrame& frame);
  /// Returns how many people collide at any time.
  std::uint64_t colliding() const noexcept { return colliding_.size(); }
  /// Returns how many frames both recordings had.
  std::uint64_t frames() const noexcept { return frames_; }

 private:
  struct Place {
    std::int64_t id;
    double x, y;
  };
  /// Holds the people of a frame, by ascending id; of the truth nobody where it lacks the frame.
  struct Places {
    std::vector<Place> predicted, true_ones;
  };

  void read_truth(std::int64_t frame);
  static std::vector<Place> halfway(std::span<const Place> from, std::span<const Place> to);
  void find(std::span<const Place> predicted, std::vector<Place> others);

  TrajectoryReader& truth_;
  bool at_end_ = false;
  std::int64_t read_frame_ = 0;  ///< of the people who were read last
  std::vector<TrackedPerson> read_;
  Places last_, now_;
  std::uint64_t frames_ = 0;
  std::unordered_set<std::uint64_t, MixedHash> colliding_;
};

}  // namespace bch::detail
