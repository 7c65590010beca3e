// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/enclosing_disc/enclosing_discs.hpp"

#include <algorithm>

namespace bch::detail {

/// Solves the sets in the order of their sizes, so that lanes have little to wait for.
void EnclosingDiscs::solve(std::span<const Vec2> points, std::span<const PointRange> sets,
                           std::span<SolvedDisc> discs) {
  std::uint32_t largest = 4;
  for (const auto [begin, end] : sets) largest = std::max(largest, end - begin);
  offset_.assign(largest + 2, 0);
  for (const auto [begin, end] : sets) ++offset_[end - begin + 1];
  for (std::uint32_t size = 1; size < offset_.size(); ++size) offset_[size] += offset_[size - 1];
  const std::uint32_t small_count = offset_[5];
  order_.resize(sets.size());
  for (std::uint32_t i = 0; i < sets.size(); ++i) order_[offset_[sets[i].end - sets[i].begin]++] = i;
  scratch_.resize(std::max(scratch_.size(), 2 * std::size_t{largest + 1} * disc_set_lanes));
  loops_->solve_discs(
      {points.data(), sets.data(), order_.data(), small_count, sets.size(), scratch_.data(), discs.data()});
}

}  // namespace bch::detail
