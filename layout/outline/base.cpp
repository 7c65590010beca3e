// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline/lanes.hpp"

namespace bch::detail {

void find_sides_base(const std::uint32_t* corners, std::size_t count, const GridPoint* points,
                     std::uint8_t* sides) noexcept {
  OutlineLanes<BaseLanes>::find_sides(corners, count, points, sides);
}
std::size_t find_near_base(const SegmentSearch& job, const SearchedWay& way) noexcept {
  return OutlineLanes<BaseLanes>::find_near(job, way);
}
void test_near_base(const SegmentSearch& job, const SearchedWay& way, std::size_t count) noexcept {
  OutlineLanes<BaseLanes>::test_near(job, way, count);
}

}  // namespace bch::detail
