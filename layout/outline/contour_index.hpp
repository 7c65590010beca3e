// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "layout/outline/grid_box.hpp"

namespace bch::detail {

/// Represents an index over contours by their boxes, which finds those that may cover a point. Where contours can begin has to be
/// known beforehand: a binary tree over these places takes in a contour, and finds those about a point, in time
/// logarithmic in their number as long as few boxes overlap. Keeps its memory.
class ContourIndex {
 public:
  /// Reserves room for so many places, so that begin() allocates nothing.
  void reserve(std::size_t places);

  /// Forgets all contours. Contours added from now on begin in these places.
  void begin(std::span<const GridPoint> places);

  /// Adds a contour that begins in that place, by its number and a box around it.
  void add(std::size_t place, std::size_t contour, const GridBox& box);

  /// Returns whether `accept`, a function of a contour's number, accepts a contour whose box holds the point.
  template <class Accept>
  bool any(GridPoint point, Accept accept) const {
    std::size_t open[max_open], count = 0;
    if (!boxes_.empty()) open[count++] = root;
    while (count > 0) {
      const std::size_t node = open[--count];
      if (!boxes_[node].holds(point)) continue;
      if (node < leaves_)
        open[count++] = 2 * node, open[count++] = 2 * node + 1;
      else if (accept(contour_[node - leaves_]))
        return true;
    }
    return false;
  }

 private:
  /// The number of the root. A node's children are at twice its number and the next one.
  static constexpr std::size_t root = 1;
  /// The most nodes that wait: one of each level and both of the last. A tree has fewer levels than a number
  /// has bits.
  static constexpr std::size_t max_open = 65;

  struct Place {
    std::uint64_t along_curve;
    std::uint32_t number;
  };

  std::size_t leaves_ = 0;
  std::vector<Place> sorted_;
  std::vector<std::uint32_t> leaf_;   ///< of each place
  std::vector<GridBox> boxes_;        ///< of node i, which holds nothing at first; leaves from leaves_ on
  std::vector<std::size_t> contour_;  ///< of each leaf
};

}  // namespace bch::detail
