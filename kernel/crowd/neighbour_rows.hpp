// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <bch/agents.hpp>

namespace bch::detail {

/// Holds pairs that were answered, and the rows that they become: of each agent, its partners in the pairs that hit. The
/// three passes below, one after the other; each may run at the same time on different ranges. In which order rows
/// are filled depends on threads, what is in them does not, and sorting settles the rest.
struct NeighbourRows {
  std::span<const Pair> pairs;
  std::span<const std::uint8_t> hits;
  std::span<std::uint64_t> begin;       ///< per agent, and the end of all
  std::span<std::uint32_t> neighbours;  ///< row after row

  /// Adds the number of each agent's partners to `begin`.
  void count(std::size_t first, std::size_t last) const noexcept;
  /// Turns the counts into the ends of rows. Returns: that of the last.
  std::uint64_t place() const noexcept;
  /// Puts pairs first .. last into their rows, from the end on, so that `begin` becomes what it says.
  void fill(std::size_t first, std::size_t last) const noexcept;
  /// Sorts the rows of agents first .. last.
  void sort(std::size_t first, std::size_t last) const noexcept;
};

}  // namespace bch::detail
