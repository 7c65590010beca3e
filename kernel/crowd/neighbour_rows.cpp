// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/crowd/neighbour_rows.hpp"

#include <algorithm>

namespace bch::detail {
namespace {

/// Returns what was there before. A builtin of the compiler, because std::atomic_ref is missing in libc++ before version 19.
std::uint64_t add(std::uint64_t& count, std::uint64_t more) noexcept {
  return __atomic_fetch_add(&count, more, __ATOMIC_RELAXED);
}

}  // namespace

void NeighbourRows::count(std::size_t first, std::size_t last) const noexcept {
  for (std::size_t i = first; i < last; ++i) {
    add(begin[pairs[i].first], 1);
    add(begin[pairs[i].second], 1);
  }
}

std::uint64_t NeighbourRows::accumulate() const noexcept {
  std::uint64_t end = 0;
  for (std::uint64_t& row : begin) row = end += row;
  return end;
}

void NeighbourRows::fill(std::size_t first, std::size_t last) const noexcept {
  for (std::size_t i = first; i < last; ++i) {
    const auto [a, b] = pairs[i];
    const auto number = static_cast<std::uint32_t>(i);
    neighbours[add(begin[a], ~std::uint64_t{0}) - 1] = {b, number};
    neighbours[add(begin[b], ~std::uint64_t{0}) - 1] = {a, number};
  }
}

void NeighbourRows::sort(std::size_t first, std::size_t last) const noexcept {
  for (std::size_t i = first; i < last; ++i)
    std::sort(neighbours.begin() + static_cast<std::ptrdiff_t>(begin[i]),
              neighbours.begin() + static_cast<std::ptrdiff_t>(begin[i + 1]),
              [](Crowd::Neighbour a, Crowd::Neighbour b) { return a.agent < b.agent; });
}

}  // namespace bch::detail
