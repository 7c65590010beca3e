// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/agents.hpp>

#include "kernel/recordings/walkers.hpp"

namespace bch::detail {

/// Holds successive frames that are checked at once. The last one only serves for contacts between it and the
/// one before.
class FrameBlock {
 public:
  /// An index that means no person.
  static constexpr std::uint32_t nobody = 0xffff'ffff;

  std::size_t frames() const noexcept { return frames_.size(); }
  std::int64_t frame(std::size_t i) const noexcept { return frames_[i]; }
  /// Returns the index of the first person of frame i; for i = frames(), the number of people.
  std::size_t begin(std::size_t i) const noexcept { return begin_[i]; }
  std::span<const Walker> people() const noexcept { return people_; }
  /// Return, by person, the index of the frame, and of the same person in the next frame, or nobody.
  std::span<const std::uint32_t> frame_of() const noexcept { return frame_of_; }
  std::span<const std::uint32_t> next_of() const noexcept { return next_of_; }

  /// Reads frames until there are about `people` people, after the last frame of the previous block, if there
  /// was one. Returns whether the recording ends with this block.
  bool read(WalkerReader& reader, std::size_t people, const FrameBlock& before);

  /// Return the positions and headings of the people.
  std::span<const double> x() const noexcept { return x_; }
  std::span<const double> y() const noexcept { return y_; }
  std::span<const double> heading() const noexcept { return heading_; }
  /// Returns x with every frame shifted far from the others, so that only people of the same frame are
  /// neighbours (except in frames that extend over hundreds of kilometres).
  std::span<const double> apart_x() const noexcept { return apart_x_; }

 private:
  void begin_with_last_of(const FrameBlock& before);
  void add(const WalkerFrame& frame);
  void place();
  void find_next(std::size_t frame);

  std::vector<std::int64_t> frames_;
  std::vector<std::size_t> begin_;
  std::vector<std::uint32_t> frame_of_, next_of_;
  std::vector<Walker> people_;
  std::vector<double> x_, y_, heading_, apart_x_;
};

}  // namespace bch::detail
