// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline/lanes.hpp"

namespace bch::detail {
namespace {

struct Avx2Lanes : Lanes<xsimd::avx2, Avx2Lanes> {};

}  // namespace

void find_sides_avx2(const std::uint32_t* corners, std::size_t count, const GridPoint* points,
                     std::uint8_t* sides) noexcept {
  OutlineLanes<Avx2Lanes>::find_sides(corners, count, points, sides);
}
std::size_t find_near_avx2(const SegmentSearch& job, const SearchedWay& way) noexcept {
  return OutlineLanes<Avx2Lanes>::find_near(job, way);
}
void test_near_avx2(const SegmentSearch& job, const SearchedWay& way, std::size_t count) noexcept {
  OutlineLanes<Avx2Lanes>::test_near(job, way, count);
}

}  // namespace bch::detail
