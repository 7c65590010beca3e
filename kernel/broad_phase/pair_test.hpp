// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/crowd.hpp>

namespace bch::detail {

/// Selects among the pairs of a broad phase: those that a filter accepts, and in a periodic crowd those of an
/// agent with a later agent or with that agent's image. Keeps its memory from crowd to crowd.
class PairTest {
 public:
  /// Sets the filter, whose arrays must outlive the tests, and the agent of each image.
  /// Errors:  throws std::invalid_argument on sizes that differ, and on an excluded pair with an index out of
  ///          range.
  void set(const PairFilter& filter, std::size_t agents, std::span<const std::uint32_t> origin_of_image);

  bool accepts_all() const noexcept {
    return category_.empty() && mask_.empty() && excluded_.empty() && origin_of_image_.empty();
  }
  /// Returns the agent of an image; an agent itself.
  std::uint32_t origin(std::uint32_t i) const noexcept {
    return i < agents_ ? i : origin_of_image_[i - agents_];
  }
  bool accepts(Pair pair) const noexcept;

 private:
  std::size_t agents_ = 0;
  std::span<const std::uint32_t> category_, mask_, origin_of_image_;
  std::vector<Pair> excluded_;  ///< first < second, ascending
};

}  // namespace bch::detail
