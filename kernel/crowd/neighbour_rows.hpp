// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <bch/crowd.hpp>

namespace bch::detail {

/// Turns pairs into rows: of each agent, the others of its pairs. The three passes below follow one another; each may run at the same
/// time on different ranges. In which order rows are filled depends on threads; sorting removes that.
struct NeighbourRows {
  std::span<const Pair> pairs;
  std::span<std::uint64_t> begin;          ///< per agent, and the end of all
  std::span<Crowd::Neighbour> neighbours;  ///< row after row

  /// Adds the number of each agent's neighbours in pairs first .. last to `begin`.
  void count(std::size_t first, std::size_t last) const noexcept;
  /// Turns the counts into the ends of rows, and returns that of the last.
  std::uint64_t accumulate() const noexcept;
  /// Inserts pairs first .. last into their rows, from the end on, so that `begin` becomes what its name says.
  void fill(std::size_t first, std::size_t last) const noexcept;
  /// Sorts the rows of agents first .. last.
  void sort(std::size_t first, std::size_t last) const noexcept;
};

}  // namespace bch::detail
