// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace bch {

/// What an element, a segment or a triangle, counts for while nodes are divided. Axis 0 is x, 1 is y.
struct alignas(64) SplitItem {
  float box[4];      ///< low x, low y, -high x, -high y: one minimum grows it
  double moment[2];  ///< what it adds to its node's centroid, which is the sum of these over that of weights
  double weight[2];  ///< twice the same: one for either side of a plane
  double middle[2];  ///< the point that decides its side
};

/// The box and centroid of a node's items.
struct SplitMeasure {
  float box[4];  ///< as SplitItem::box
  double moment[2];
  double weight;

  double low(int axis) const { return static_cast<double>(box[axis]); }
  double high(int axis) const { return -static_cast<double>(box[2 + axis]); }
  double extent(int axis) const { return high(axis) - low(axis); }
  int longer_axis() const { return extent(0) >= extent(1) ? 0 : 1; }
};

/// Names items by index, so that dividing them moves four bytes each.
using ItemOrder = std::span<std::uint32_t>;

/// One pass, the sums in order. At least one item.
SplitMeasure measure(std::span<const SplitItem> items, std::span<const std::uint32_t> order);

/// Reorders a node's items, two at least, so that those before a plane come first and both sides keep their
/// order; neither side is empty. The plane's normal is the longer axis, or the other one where that would
/// leave a side empty; where both would, the items are halved by count. Returns the size of the first side and
/// both sides' measures.
/// `through_centre`: the plane halves the extent instead of passing through the centroid.
/// `scratch`: room for as many.
std::size_t divide(std::span<const SplitItem> items, ItemOrder order, const SplitMeasure& whole,
                   bool through_centre, std::uint32_t* scratch, SplitMeasure& first, SplitMeasure& second);

/// The same for two items, without the measures.
void divide_pair(std::span<const SplitItem> items, ItemOrder order, const SplitMeasure& whole,
                 bool through_centre);

}  // namespace bch
