// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/culling/supports.hpp"

#include <numbers>

#include "layout/base/build_implementation.hpp"
#include "layout/base/heading.hpp"
#include "layout/base/rounding.hpp"
#include "layout/culling/cut_lanes.hpp"

namespace bch::detail {
namespace {

/// The directions of the first quadrant.
struct Directions {
  std::array<float, support_directions / 4> cosine, sine;

  Directions() {
    for (std::uint32_t k = 0; k < cosine.size(); ++k) {
      const Rotation direction = rotation(2 * std::numbers::pi * k / support_directions);
      cosine[k] = static_cast<float>(direction.cosine);
      sine[k] = static_cast<float>(direction.sine);
    }
  }
};

}  // namespace

void PointDiscs::assign(const Outline& outline) {
  x.clear(), y.clear();
  radius.assign(outline.points.size(), 0);
  for (const Vec2& point : outline.points) x.push_back(point.x), y.push_back(point.y);
}

/// Computes the supports in float, which is off by 0.71 u of the extent for the direction, 1.42 u for the
/// products, u and 2 u for the sums: (support_float) of rounding.hpp.
static_assert(rounding::terms::support_float >= 1.5 * rounding::terms::root_2 + 1 + 2);
Supports supports(const float* x, const float* y, const float* radius, std::uint32_t count,
                  double max_extent) {
  static const Directions directions;
  std::array<float, support_directions> largest;
  best_build_implementation().loops.heights({x, y, radius, count}, directions.cosine.data(),
                                            directions.sine.data(), largest.data());
  Supports heights;
  for (std::uint32_t k = 0; k < support_directions; ++k) {
    const std::uint32_t at = k % 2 * support_directions + k / 2;
    heights[at] = heights[at + support_directions / 2] =
        static_cast<float>(static_cast<double>(largest[k]) + rounding::support_margin * max_extent);
  }
  return heights;
}

Supports supports(std::span<const Disc> discs, double max_extent) {
  std::vector<float> x, y, radius;
  for (const Disc& disc : discs) x.push_back(disc.x), y.push_back(disc.y), radius.push_back(disc.radius);
  return supports(x.data(), y.data(), radius.data(), static_cast<std::uint32_t>(discs.size()), max_extent);
}

}  // namespace bch::detail
