// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "layout/outline/grid_box.hpp"

namespace bch::detail {

/// Finds the contours that may contain a point: a binary tree over the boxes of contours. The places where contours
/// can begin are given beforehand and become the leaves. Adding a contour and finding the contours around a point
/// take time logarithmic in the number of places, as long as few boxes overlap. Reuses its memory.
class ContourIndex {
 public:
  /// Reserves memory for this many places, so that begin() allocates nothing.
  void reserve(std::size_t places);

  /// Removes all contours. Contours added from now on begin at one of these places.
  void begin(std::span<const GridPoint> places);

  /// Adds a contour by the index of the place where it begins, its number and a box around it.
  void add(std::size_t place, std::size_t contour, const GridBox& box);

  /// Calls accept(number) for contours whose box contains the point until one is accepted. Returns whether one was.
  template <class Accept>
  bool any(GridPoint point, Accept accept) const {
    std::size_t pending[max_pending], count = 0;
    if (!boxes_.empty()) pending[count++] = root;
    while (count > 0) {
      const std::size_t node = pending[--count];
      if (!boxes_[node].contains(point)) continue;
      if (node < leaves_)
        pending[count++] = 2 * node, pending[count++] = 2 * node + 1;
      else if (accept(contour_[node - leaves_]))
        return true;
    }
    return false;
  }

 private:
  /// The root. The children of node i are 2 i and 2 i + 1.
  static constexpr std::size_t root = 1;
  /// The most pending nodes: one per level and two of the last. A tree has fewer levels than std::size_t has bits.
  static constexpr std::size_t max_pending = 65;

  struct Place {
    std::uint64_t along_curve;  ///< position on Morton's space-filling curve
    std::uint32_t number;
  };

  std::size_t leaves_ = 0;
  std::vector<Place> sorted_;
  std::vector<std::uint32_t> leaf_;   ///< per place
  std::vector<GridBox> boxes_;        ///< per node, at first empty_box; leaves begin at leaves_
  std::vector<std::size_t> contour_;  ///< per leaf
};

}  // namespace bch::detail
