// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline/mesh_between.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "layout/base/number_class.hpp"

namespace bch::detail {
namespace {

struct Corner {
  double x, y, z;
};
using Polygon = std::vector<Corner>;

/// The order of the ends decides nothing: an edge always goes up.
Corner crossing(Corner low, Corner high, double z) {
  if (high.z < low.z) std::swap(low, high);
  const double t = (z - low.z) / (high.z - low.z);
  return {low.x + (high.x - low.x) * t, low.y + (high.y - low.y) * t, z};
}

/// Writes what of a convex polygon lies above a height, or below it.
void clip(const Polygon& polygon, double z, bool above, Polygon& rest) {
  rest.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    const bool is_in = (z < from.z) == above;
    if (is_in) rest.push_back(from);
    if (is_in != ((z < to.z) == above)) rest.push_back(crossing(from, to, z));
  }
}

void require_finite(const Vec3& position, std::uint32_t vertex) {
  if (!is_finite(position.x) || !is_finite(position.y))
    throw std::invalid_argument("outline: vertex " + std::to_string(vertex) + " is not finite");
  if (!is_finite(position.z))
    throw std::invalid_argument("outline: the height of vertex " + std::to_string(vertex) + " is not finite");
}

}  // namespace

double height_of_cut(float number) {
  return 0.5 * (double{number} + double{std::nextafter(number, std::numeric_limits<float>::infinity())});
}

std::vector<std::array<Vec3, 3>> mesh_between(std::span<const Vec3> positions,
                                              std::span<const std::array<std::uint32_t, 3>> triangles,
                                              const Heights& heights) {
  const double bottom = height_of_cut(heights.bottom), top = height_of_cut(heights.top);
  std::vector<std::array<Vec3, 3>> pieces;
  Polygon whole, higher, polygon;
  for (const auto& corners : triangles) {
    whole.clear();
    for (const std::uint32_t v : corners) {
      require_finite(positions[v], v);
      whole.push_back({positions[v].x, positions[v].y, positions[v].z});
    }
    clip(whole, bottom, true, higher);
    clip(higher, top, false, polygon);
    const auto corner = [&](std::size_t i) {
      const auto& [x, y, z] = polygon[i];
      return Vec3{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
    };
    for (std::size_t i = 2; i < polygon.size(); ++i) pieces.push_back({corner(0), corner(i - 1), corner(i)});
  }
  return pieces;
}

}  // namespace bch::detail
