// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline/implementation.hpp"

namespace bch::detail {

void find_sides_base(const std::uint32_t*, std::size_t, const GridPoint*, std::uint8_t*) noexcept;
void find_sides_avx2(const std::uint32_t*, std::size_t, const GridPoint*, std::uint8_t*) noexcept;
std::size_t find_near_base(const SegmentSearch&, const SearchedWay&) noexcept;
std::size_t find_near_avx2(const SegmentSearch&, const SearchedWay&) noexcept;
void test_near_base(const SegmentSearch&, const SearchedWay&, std::size_t) noexcept;
void test_near_avx2(const SegmentSearch&, const SearchedWay&, std::size_t) noexcept;

namespace {

constexpr OutlineImplementation outline_table[] = {
    BCH_ON_X86({avx2, find_sides_avx2, find_near_avx2, test_near_avx2}, ){base, find_sides_base,
                                                                          find_near_base, test_near_base},
};

}  // namespace

std::span<const OutlineImplementation> outline_implementations() noexcept {
  return outline_table;
}

const OutlineImplementation& best_outline_implementation() noexcept {
  static const OutlineImplementation& best = first_supported(outline_table);
  return best;
}

}  // namespace bch::detail
