// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/supports.hpp"

#include <algorithm>
#include <numbers>

#include "layout/heading.hpp"
#include "layout/rounding.hpp"

namespace bch {

Supports supports(std::span<const Disc> discs, double reach) {
  Supports heights;
  for (std::uint32_t k = 0; k < support_directions; ++k) {
    const Rotation direction = rotation(2 * std::numbers::pi * k / support_directions);
    double largest = -3 * reach;
    for (const Disc& disc : discs)
      largest = std::max(largest, direction.cosine * static_cast<double>(disc.x) +
                                      direction.sine * static_cast<double>(disc.y) +
                                      static_cast<double>(disc.radius));
    largest += rounding::support_margin * reach;
    const std::uint32_t at = k % 2 * support_directions + k / 2;
    heights[at] = heights[at + support_directions / 2] = static_cast<float>(largest);
  }
  return heights;
}

}  // namespace bch
