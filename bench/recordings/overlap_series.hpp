// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace bch::cli {

/// Counts how many people overlap over time, for a timeline. It keeps the most of each of a few thousand equal
/// stretches of frames, which become longer as frames are added.
class OverlapSeries {
 public:
  static constexpr std::size_t most_stretches = 4096;  // even

  void add(double seconds, std::uint32_t overlapping, std::uint32_t people);
  std::string blocks() const;

 private:
  std::uint64_t length_ = 1, in_last_ = 0;  ///< frames of a stretch, and of the last one so far
  std::vector<double> seconds_;             ///< of the first frame of each stretch
  std::vector<std::uint32_t> overlapping_, people_;
};

}  // namespace bch::cli
