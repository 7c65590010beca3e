// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "layout/hierarchy/split_items.hpp"

namespace bch::detail {

/// Holds the box and the sums for the centroid of a node's items.
struct SplitMeasure {
  float box[4], sums[4];  ///< as in SplitItem

  double extent(int axis) const {
    return -static_cast<double>(box[2 + axis]) - static_cast<double>(box[axis]);
  }
};

/// Lists items by index, so that a split moves only four bytes per item.
using ItemList = std::span<const std::uint32_t>;

/// Measures at least one item in one pass, adding the sums in order.
SplitMeasure measure(const SplitItems& items, ItemList list);

/// Splits at least two items of a node by a plane, so that the items before the plane come first. Both sides keep
/// their order, and neither is empty. The normal of the plane is the longer axis, or the other axis if that leaves a
/// side empty. If both axes do, the items are halved by count.
/// `through_centre`: the plane halves the extent instead of passing through the centroid.
/// `first_list`, `second_list`: receive the sides. Each has room for all items; `list` may be in either.
/// Returns: the size of the first side; `first` and `second` receive the measures of the sides.
std::size_t divide(const SplitItems& items, ItemList list, const SplitMeasure& whole, bool through_centre,
                   std::uint32_t* first_list, std::uint32_t* second_list, SplitMeasure& first,
                   SplitMeasure& second);

/// Splits a node of two items, writes both to `both`, and computes no measures.
void divide_pair(const SplitItems& items, ItemList list, const SplitMeasure& whole, bool through_centre,
                 std::uint32_t* both);

}  // namespace bch::detail
