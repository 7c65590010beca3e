// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "layout/hierarchy/split_items.hpp"

namespace bch::detail {

/// Holds the box and centroid of a node's items.
struct SplitMeasure {
  float box[4], sums[4];  ///< as a SplitItem's

  double extent(int axis) const {
    return -static_cast<double>(box[2 + axis]) - static_cast<double>(box[axis]);
  }
};

/// Names items by index, so that dividing them moves four bytes each.
using ItemList = std::span<const std::uint32_t>;

/// Measures items in one pass, the sums in order. There is at least one item.
SplitMeasure measure(const SplitItems& items, ItemList list);

/// Divides a node's items, two at least, so that those before a plane come first and both sides keep their
/// order; neither side is empty. The plane's normal is the longer axis, or the other one where that would
/// leave a side empty; where both would, the items are halved by count.
/// `through_centre`: the plane halves the extent instead of passing through the centroid.
/// `first_list`, `second_list`: where the sides go; each has room for all items, and the list may stand in either.
/// Returns: the size of the first side, and both sides' measures.
std::size_t divide(const SplitItems& items, ItemList list, const SplitMeasure& whole, bool through_centre,
                   std::uint32_t* first_list, std::uint32_t* second_list, SplitMeasure& first,
                   SplitMeasure& second);

/// Divides a node of two items, writes both to one place, and computes no measures.
void divide_pair(const SplitItems& items, ItemList list, const SplitMeasure& whole, bool through_centre,
                 std::uint32_t* both);

}  // namespace bch::detail
