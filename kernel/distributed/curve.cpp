// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/distributed/curve.hpp"

#include <cmath>
#include <utility>

namespace bch::detail {

Cell cell_at(double x, double y, double side) {
  return {static_cast<std::int32_t>(std::floor(x / side)), static_cast<std::int32_t>(std::floor(y / side))};
}

// D. Hilbert, "Ueber die stetige Abbildung einer Linie auf ein Flaechenstueck", 1891: quadrant by quadrant from the largest, each
// turned so that its curve begins where the one before ends.
std::uint64_t curve_key(Cell cell) {
  constexpr std::uint32_t middle = 1u << 31;  // columns and rows from 0 on
  std::uint32_t x = static_cast<std::uint32_t>(cell.x) + middle;
  std::uint32_t y = static_cast<std::uint32_t>(cell.y) + middle;
  std::uint64_t key = 0;
  for (std::uint32_t half = middle; half > 0; half >>= 1) {
    const bool right = x & half, upper = y & half;
    key = key << 2 | (right ? (upper ? 2u : 3u) : (upper ? 1u : 0u));
    if (upper) continue;
    if (right) x = ~x, y = ~y;
    std::swap(x, y);
  }
  return key;
}

}  // namespace bch::detail
