// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cmath>

#include <bch/geometry.hpp>

namespace bch::detail {

inline double length(double x, double y) noexcept {
  return std::sqrt(x * x + y * y);
}

/// Represents the smallest axis-aligned box around discs.
struct DiscBox {
  double low_x = HUGE_VAL, low_y = HUGE_VAL, high_x = -HUGE_VAL, high_y = -HUGE_VAL;

  void add(const Disc& disc) noexcept {
    const double x = disc.x, y = disc.y, r = disc.radius;
    low_x = std::min(low_x, x - r), high_x = std::max(high_x, x + r);
    low_y = std::min(low_y, y - r), high_y = std::max(high_y, y + r);
  }
  double size() const noexcept { return length(high_x - low_x, high_y - low_y); }
};

}  // namespace bch::detail
