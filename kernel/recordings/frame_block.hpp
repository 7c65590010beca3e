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

/// Holds consecutive frames that are checked at once. The last one is there for what happens between it and the one before.
class FrameBlock {
 public:
  /// Stands for nobody.
  static constexpr std::uint32_t nobody = 0xffff'ffff;

  std::size_t frames() const noexcept { return frames_.size(); }
  std::int64_t frame(std::size_t i) const noexcept { return frames_[i]; }
  /// Returns where the people of frame i begin, and, for i = frames(), their number.
  std::size_t begin(std::size_t i) const noexcept { return begin_[i]; }
  std::span<const Walker> people() const noexcept { return people_; }
  /// Returns, by person, the frame, and the same person in the frame behind it, or nobody.
  std::span<const std::uint32_t> frame_of() const noexcept { return frame_of_; }
  std::span<const std::uint32_t> next_of() const noexcept { return next_of_; }

  /// Reads frames until there are about so many people. They begin with the last frame of the block before, if there was one.
  /// Returns whether the recording ends with this block.
  bool read(WalkerReader& reader, std::size_t people, const FrameBlock& before);

  /// Returns the people as agents.
  std::span<const double> x() const noexcept { return x_; }
  std::span<const double> y() const noexcept { return y_; }
  std::span<const double> heading() const noexcept { return heading_; }
  /// Returns where they are if every frame stands far from the others, so that people of one frame alone are neighbours. (Where the places of a
  /// frame are hundreds of kilometres from each other, there are others.)
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
