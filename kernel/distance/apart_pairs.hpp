// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <bch/query.hpp>

#include "kernel/simd/arguments.hpp"

namespace bch::detail {

/// Holds the pairs of a task that a search for distances or times has to examine, and their indices among the
/// task's pairs.
class ApartPairs {
 public:
  static constexpr std::size_t capacity = 1024;  ///< pairs of a task

  /// Collects the pairs that do not collide. The stages of collide() find the colliding ones faster, with
  /// culling data.
  void collect_apart(const Implementation& implementation, Arguments in,
                     std::span<const Pair> pairs) noexcept;
  void collect_all(std::span<const Pair> pairs) noexcept;

  std::size_t size() const noexcept { return size_; }
  std::span<const Pair> pairs() const noexcept { return {pair_, size_}; }
  std::size_t index(std::size_t k) const noexcept { return index_[k]; }

 private:
  void collect(std::span<const Pair> pairs, const std::uint8_t* states) noexcept;

  std::size_t size_ = 0;
  Pair pair_[capacity];
  std::uint16_t index_[capacity];
};

}  // namespace bch::detail
