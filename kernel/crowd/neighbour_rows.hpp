// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <bch/crowd.hpp>

namespace bch::detail {

/// Turns pairs into one row of neighbours per agent. Call count(), accumulate(), fill() and sort() in this order; each but
/// accumulate() may run at the same time on different ranges. Rows are filled in an order that depends on threads, and sorted.
struct NeighbourRows {
  std::span<const Pair> pairs;
  std::span<std::uint64_t> begin;          ///< per agent, and the end of the last row
  std::span<Crowd::Neighbour> neighbours;  ///< row after row

  /// Adds the number of each agent's neighbours in pairs first .. last to `begin`.
  void count(std::size_t first, std::size_t last) const noexcept;
  /// Turns the counts into the ends of rows, and returns the last end.
  std::uint64_t accumulate() const noexcept;
  /// Inserts pairs first .. last into their rows. Each row is filled backwards from its end, so that `begin`, which
  /// held the ends, holds the begins once all pairs are inserted.
  void fill(std::size_t first, std::size_t last) const noexcept;
  /// Sorts the rows of agents first .. last.
  void sort(std::size_t first, std::size_t last) const noexcept;
};

}  // namespace bch::detail
