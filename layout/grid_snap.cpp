// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/grid_snap.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <string>

#include "layout/rounding.hpp"

namespace bch {
namespace {

constexpr int grid_bits = 23;

/// The largest |x| or |y|. Bits of a float without its sign are in the order of the values, with infinities
/// and NaN above all: one maximum looks for those as well.
float largest_coordinate(std::span<const Eigen::Vector3f> positions, std::span<const std::uint32_t> used) {
  std::uint32_t largest = 0;
  for (const std::uint32_t v : used)
    for (const float coordinate : {positions[v].x(), positions[v].y()})
      largest = std::max(largest, std::bit_cast<std::uint32_t>(coordinate) & 0x7fffffffu);
  return std::bit_cast<float>(largest);
}

[[noreturn]] void reject(std::span<const Eigen::Vector3f> positions, std::span<const std::uint32_t> used,
                         float reach) {
  for (const std::uint32_t v : used)
    if (!std::isfinite(positions[v].x()) || !std::isfinite(positions[v].y()))
      throw std::invalid_argument("outline: vertex " + std::to_string(v) + " is not finite");
  throw std::invalid_argument("outline: reach " + std::to_string(reach) + " m is outside 1e-6 to 1e6 m");
}

}  // namespace

double snap_to_grid(std::span<const Eigen::Vector3f> positions, std::span<const std::uint32_t> used,
                    std::span<GridPoint> points) {
  const float reach = largest_coordinate(positions, used);
  if (!(static_cast<double>(reach) >= rounding::smallest_reach &&
        static_cast<double>(reach) <= rounding::largest_reach))
    reject(positions, used, reach);

  const double step = std::ldexp(1.0, std::ilogb(reach) + 1 - grid_bits), steps_per_metre = 1 / step;
  // Adding 1.5 * 2^52 leaves no bit for fractions, so the sum is rounded to an integer (a half to even), whose
  // low half is that of the sum's bits.
  const auto to_grid = [steps_per_metre](float metres) {
    const double shifted = static_cast<double>(metres) * steps_per_metre + 0x1.8p52;
    return static_cast<std::int32_t>(std::bit_cast<std::int64_t>(shifted));
  };
  for (std::size_t i = 0; i < used.size(); ++i) {
    const Eigen::Vector3f& p = positions[used[i]];
    points[i] = {to_grid(p.x()), to_grid(p.y())};
  }
  return step;
}

}  // namespace bch
