// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/crowd.hpp>

namespace bch::detail {

/// Decides which of the pairs that a broad phase finds count: those that a filter selects, and of a periodic crowd those of an
/// agent with a later one or its image. Keeps its memory from crowd to crowd.
class PairTest {
 public:
  /// Takes a filter, whose arrays have to live as long as pairs are tested, and the agents that images stand for.
  /// Errors:  throws std::invalid_argument on sizes that differ, and on an excluded pair with an index out of range.
  void set(const PairFilter& filter, std::size_t agents, std::span<const std::uint32_t> origin_of_image);

  bool accepts_all() const noexcept {
    return category_.empty() && mask_.empty() && excluded_.empty() && origin_of_image_.empty();
  }
  /// Returns the agent that an agent or an image stands for.
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
