// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "layout/outline/grid_box.hpp"
#include "layout/outline/walk.hpp"

namespace bch::detail {

/// Holds the contours of a pose, to be asked whether one of them covers a point. Keeps its memory.
class ContourCovers {
 public:
  void clear();
  /// Adds the next contour. Its stretches need not live on.
  void add(std::span<const Stretch> contour);

  std::size_t size() const { return begin_.size() - 1; }
  /// Returns whether a point is inside contour i, which has the given stretches, or on it, exactly.
  bool covers(std::size_t i, std::span<const Stretch> contour, GridPoint point) const;

 private:
  /// The places where stretches begin, rounded. After a contour's last one its first is repeated.
  std::vector<std::int32_t> x_, y_;
  std::vector<GridBox> boxes_;  ///< of the stretches of a contour, part after part
  std::vector<std::size_t> begin_ = {0}, boxes_begin_ = {0};
};

}  // namespace bch::detail
