// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <bch/agents.hpp>

#include "kernel/broad_phase/crowd_grid.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Holds discs of a grid, sorted by cell, as a structure of arrays.
class SortedDiscs {
 public:
  /// The narrowest registers: most sequences of neighbours are short, so wider registers would gain little.
  using Simd = BaseLanes;
  static constexpr std::size_t width = Simd::width;

  std::size_t size() const noexcept { return cell_.size(); }
  std::uint64_t cell(std::size_t i) const noexcept { return cell_[i]; }

  void resize(std::size_t size) {
    cell_.resize(size);
    // Whole registers are read; values beyond the last disc are ignored.
    x_.resize(size + width);
    y_.resize(size + width);
    radius_.resize(size + width);
    agent_.resize(size + width);
  }

  void set(std::size_t i, const GridDisc& disc) noexcept {
    cell_[i] = disc.cell;
    x_[i] = static_cast<std::int32_t>(disc.x);
    y_[i] = static_cast<std::int32_t>(disc.y);
    radius_[i] = disc.radius;
    agent_[i] = disc.agent;
  }

  /// Returns the first of discs begin .. end whose cell is at least `from`, or end.
  std::size_t first_from(std::uint64_t from, std::size_t begin, std::size_t end) const noexcept {
    const std::uint64_t* const cells = cell_.data();
    return static_cast<std::size_t>(std::lower_bound(cells + begin, cells + end, from) - cells);
  }

  /// Writes (agent of i, agent of j) for each j in begin .. end whose disc overlaps that of i.
  /// Returns: one past the last pair. There must be room for end - begin + width pairs.
  Pair* write_overlapping(std::size_t i, std::size_t begin, std::size_t end, Pair* pairs) const noexcept {
    const Simd::Ints x(x_[i]), y(y_[i]);
    const Simd::Float radius(radius_[i]);
    const std::uint32_t agent = agent_[i];
    for (std::size_t first = begin; first < end; first += width) {
      const Simd::Float dx = xsimd::to_float(Simd::load(x_.data() + first) - x);
      const Simd::Float dy = xsimd::to_float(Simd::load(y_.data() + first) - y);
      const Simd::Float r = Simd::load(radius_.data() + first) + radius;
      std::uint32_t hits = Simd::bits(dx * dx + dy * dy <= r * r);
      hits &= (1u << std::min(width, end - first)) - 1;
      // Every lane writes, but only a hit advances: a branch would be unpredictable.
      for (std::size_t k = 0; k < width; ++k) {
        *pairs = {agent, agent_[first + k]};
        pairs += hits >> k & 1;
      }
    }
    return pairs;
  }

 private:
  std::vector<std::uint64_t> cell_;
  std::vector<std::int32_t> x_, y_;  ///< modulo 2^32, see GridDisc
  std::vector<float> radius_;
  std::vector<std::uint32_t> agent_;
};

/// Counts the pairs of all tasks, up to a limit.
class PairCount {
 public:
  explicit PairCount(std::size_t most) noexcept : max_pairs_(most) {}
  /// Errors:  throws std::length_error above the limit.
  void add(std::size_t pairs) {
    if (count_.fetch_add(pairs, std::memory_order_relaxed) + pairs > max_pairs_)
      throw std::length_error("candidates: expected at most " + std::to_string(max_pairs_) +
                              " pairs, found more");
  }

 private:
  const std::size_t max_pairs_;
  std::atomic<std::size_t> count_ = 0;
};

/// Holds the pairs of a task.
class PairList {
 public:
  std::span<const Pair> pairs() const noexcept { return {pairs_.data(), size_}; }
  void clear() noexcept { size_ = counted_ = 0; }
  /// Keeps the pairs that pass a test.
  template <class Test>
  void keep_if(Test passes) {
    const auto end = pairs_.begin() + static_cast<std::ptrdiff_t>(size_);
    size_ = static_cast<std::size_t>(
        std::remove_if(pairs_.begin(), end, [&](const Pair& pair) { return !passes(pair); }) -
        pairs_.begin());
  }

  /// Adds the pairs of disc i with the discs in begin .. end that overlap it.
  void add_overlapping(const SortedDiscs& discs, std::size_t i, std::size_t begin, std::size_t end,
                       PairCount& count) {
    const std::size_t most = size_ + (end - begin) + SortedDiscs::width;
    if (most > pairs_.size()) pairs_.resize(2 * most);
    size_ = static_cast<std::size_t>(discs.write_overlapping(i, begin, end, pairs_.data() + size_) -
                                     pairs_.data());
    if (size_ - counted_ > uncounted) [[unlikely]]
      report(count);
  }
  /// Adds the pairs not yet counted to `count`.
  void report(PairCount& count) {
    count.add(size_ - counted_);
    counted_ = size_;
  }

 private:
  static constexpr std::size_t uncounted =
      65536;  ///< pairs, approximately: frequent counting would make tasks wait for each other

  std::vector<Pair> pairs_;
  std::size_t size_ = 0, counted_ = 0;
};

}  // namespace bch::detail
