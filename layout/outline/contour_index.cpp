// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline/contour_index.hpp"

#include <algorithm>

namespace bch::detail {
namespace {

/// The number with a 0 after each bit.
std::uint64_t spread(std::uint32_t number) {
  std::uint64_t bits = number;
  bits = (bits | bits << 16) & 0x0000ffff0000ffff;
  bits = (bits | bits << 8) & 0x00ff00ff00ff00ff;
  bits = (bits | bits << 4) & 0x0f0f0f0f0f0f0f0f;
  bits = (bits | bits << 2) & 0x3333333333333333;
  return (bits | bits << 1) & 0x5555555555555555;
}

/// Returns a point's place on Morton's curve, along which neighbours are mostly near each other.
std::uint64_t morton(GridPoint point) {
  constexpr std::uint32_t offset = std::uint32_t{1} << 31;
  return spread(static_cast<std::uint32_t>(point.x) + offset) << 1 |
         spread(static_cast<std::uint32_t>(point.y) + offset);
}

}  // namespace

void ContourIndex::reserve(std::size_t places) {
  sorted_.reserve(places);
  leaf_.reserve(places);
  boxes_.reserve(2 * places);
  contour_.reserve(places);
}

void ContourIndex::begin(std::span<const GridPoint> places) {
  leaves_ = places.size();
  sorted_.clear();
  for (std::uint32_t i = 0; i < places.size(); ++i) sorted_.push_back({morton(places[i]), i});
  std::sort(sorted_.begin(), sorted_.end(),
            [](const Place& a, const Place& b) { return a.along_curve < b.along_curve; });
  leaf_.resize(leaves_);
  for (std::uint32_t i = 0; i < leaves_; ++i) leaf_[sorted_[i].number] = i;
  boxes_.assign(2 * leaves_, empty_box);
  contour_.resize(leaves_);
}

void ContourIndex::add(std::size_t place, std::size_t contour, const GridBox& box) {
  contour_[leaf_[place]] = contour;
  for (std::size_t node = leaves_ + leaf_[place]; node >= root; node /= 2) enlarge(boxes_[node], box);
}

}  // namespace bch::detail
