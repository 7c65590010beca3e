// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Finds the segments of an outline that a leaf holds. Trees have segments here, and leaves are named by the places of their discs among
/// ShapeSetView::nodes. (`Simd` keeps instruction sets from sharing a function.)
template <class Simd>
struct LeafSegments {
  const std::uint32_t* words;  ///< ShapeSetView::leaf_segments

  /// Holds the segments of a leaf, by the points where they begin.
  struct List {
    std::uint32_t first, count;   ///< 0: more than 127, so that the disc decides
    const std::uint32_t* listed;  ///< counted from the first; null: they follow each other

    std::uint32_t point(std::uint32_t i) const noexcept {
      return first + (listed == nullptr ? i : listed[i]);
    }
  };

  const std::uint32_t* word(const Tree& tree, std::uint32_t leaf) const noexcept {
    return words + tree.segments + (leaf - tree.discs);
  }
  List segments(const Tree& tree, std::uint32_t leaf) const noexcept {
    const std::uint32_t of_leaf = *word(tree, leaf);
    if (of_leaf < leaf_list) [[likely]]
      return {tree.points + (of_leaf & leaf_first_mask), of_leaf >> leaf_count_shift, nullptr};
    const std::uint32_t* const list = words + tree.segments + (of_leaf & ~leaf_list);
    return {tree.points, *list, list + 1};
  }
};

}  // namespace bch::detail
