// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/agents.hpp>

#include "kernel/check/walkers.hpp"

namespace bch::detail {

/// Frames that are checked at once, as one crowd: each stands far from the others, so that only people of the same frame meet. The
/// last one is there for what happens between it and the one before.
class FrameBlock {
 public:
  std::size_t frames() const noexcept { return frames_.size(); }
  std::int64_t frame(std::size_t i) const noexcept { return frames_[i]; }
  /// Returns where the people of frame i begin, and, for i = frames(), their number.
  std::size_t begin(std::size_t i) const noexcept { return begin_[i]; }
  std::size_t frame_of(std::size_t person) const noexcept { return frame_of_[person]; }
  std::span<const Walker> people() const noexcept { return people_; }
  std::span<const Walker> people_of(std::size_t i) const noexcept {
    return people().subspan(begin_[i], begin_[i + 1] - begin_[i]);
  }
  /// Returns the person of frame i with an id, or the number of all people where there is none.
  std::size_t find(std::size_t i, std::int64_t id) const noexcept;

  /// Reads frames until there are about so many people, behind the last frame of those before. Returns whether the recording ends with
  /// this block.
  bool read(WalkerReader& reader, std::size_t people);

  /// Returns the longest way of a person from one of the frames to the next, metres.
  double longest_step() const noexcept;

  /// The people as agents, frames far from each other.
  std::span<const double> x() const noexcept { return x_; }
  std::span<const double> y() const noexcept { return y_; }
  std::span<const double> heading() const noexcept { return heading_; }
  /// Where they are in the recording.
  std::span<const double> own_x() const noexcept { return own_x_; }

 private:
  void keep_last();
  void add(const WalkerFrame& frame);
  void place();

  std::vector<std::int64_t> frames_;
  std::vector<std::size_t> begin_{0}, frame_of_;
  std::vector<Walker> people_;
  std::vector<double> x_, y_, heading_, own_x_;
};

}  // namespace bch::detail
