// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/enclosing_disc/enclosing_discs.hpp"

#include <algorithm>

#include "layout/base/construction_implementation.hpp"

namespace bch::detail {

void solve_discs_sse2(const DiscSets&) noexcept;
void solve_discs_avx2(const DiscSets&) noexcept;
void solve_discs_avx512(const DiscSets&) noexcept;

namespace {

// The compiler's test asks the operating system too, whether it saves the wide registers.
constexpr DiscImplementation table[] = {
    {"avx512", []() noexcept { return __builtin_cpu_supports("avx512f") != 0; }, solve_discs_avx512},
    {"avx2", []() noexcept { return __builtin_cpu_supports("avx2") != 0; }, solve_discs_avx2},
    {"sse2", []() noexcept { return true; }, solve_discs_sse2},
};

const DiscImplementation& best_implementation() {
  static const DiscImplementation& best = best_for_construction(table);
  return best;
}

}  // namespace

std::span<const DiscImplementation> disc_implementations() noexcept {
  return table;
}

EnclosingDiscs::EnclosingDiscs() : EnclosingDiscs(best_implementation()) {}

EnclosingDiscs::EnclosingDiscs(const DiscImplementation& implementation) : implementation_(&implementation) {}

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
  implementation_->solve(
      {points.data(), sets.data(), order_.data(), small_count, sets.size(), scratch_.data(), discs.data()});
}

}  // namespace bch::detail
