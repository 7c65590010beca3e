// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "layout/outline/grid_box.hpp"
#include "layout/outline/walk.hpp"

namespace bch::detail {

/// Holds the contours of a pose and tests whether a contour covers a point. Reuses its memory.
class ContourCovers {
 public:
  void clear();
  /// Adds the next contour. Only the rounded points where its stretches begin are copied; covers() takes the
  /// stretches again for exact tests.
  void add(std::span<const Stretch> contour);

  std::size_t size() const { return begin_.size() - 1; }
  /// Returns whether a point is inside contour i or on it, exactly. `contour` has the stretches of that contour.
  bool covers(std::size_t i, std::span<const Stretch> contour, GridPoint point) const;

 private:
  /// The rounded places where stretches begin. After the last of a contour, its first is repeated.
  std::vector<std::int32_t> x_, y_;
  std::vector<GridBox> boxes_;  ///< of runs of stretches, contour after contour
  std::vector<std::size_t> begin_ = {0}, boxes_begin_ = {0};
};

}  // namespace bch::detail
