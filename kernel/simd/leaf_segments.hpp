// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Finds the segments of an outline that a leaf holds. A leaf is named by its disc's index in ShapeSetView::nodes.
/// Precondition: the tree has segments. (`Simd` keeps instruction sets from sharing a function.)
template <class Simd>
struct LeafSegments {
  const std::uint32_t* words;  ///< ShapeSetView::leaf_segments

  /// Holds the segments of a leaf, by the points where they begin.
  struct List {
    std::uint32_t first, count;   ///< a count of 0: more than 127 segments, so the disc decides
    const std::uint32_t* listed;  ///< offsets from `first`; null: 0, 1, ...

    std::uint32_t point(std::uint32_t i) const noexcept {
      return first + (listed == nullptr ? i : listed[i]);
    }
  };

  /// Locates the leaves of a tree from one leaf on.
  struct Row {
    const std::uint32_t* words;  ///< of all of the tree's leaves
    std::uint32_t first;         ///< that leaf, counted in the tree
    std::uint32_t points;        ///< index of the shape's first point

    std::uint32_t word(std::uint32_t i) const noexcept { return words[first + i]; }
    List segments(std::uint32_t i) const noexcept {
      const std::uint32_t of_leaf = word(i);
      if (of_leaf < leaf_list) [[likely]]
        return {points + (of_leaf & leaf_first_mask), of_leaf >> leaf_count_shift, nullptr};
      const std::uint32_t* const list = words + (of_leaf & ~leaf_list);
      return {points, *list, list + 1};
    }
  };

  Row row(const Tree& tree, std::uint32_t leaf) const noexcept {
    return {words + tree.segments, leaf - tree.discs, tree.points};
  }
  List segments(const Tree& tree, std::uint32_t leaf) const noexcept { return row(tree, leaf).segments(0); }
};

}  // namespace bch::detail
