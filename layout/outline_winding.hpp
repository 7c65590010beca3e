// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "layout/outline_walk.hpp"

namespace bch {

/// Tells of points whether a contour covers them. Keeps its memory.
class ContourCover {
 public:
  /// The stretches have to live until the next call.
  void assign(std::span<const Stretch> contour);

  /// Whether a point is inside the contour or on it, exactly.
  bool covers(GridPoint point) const;

 private:
  std::span<const Stretch> contour_;
  std::vector<std::int32_t> x_, y_;  ///< where stretches begin, rounded, and the first ones again
};

}  // namespace bch
