// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/shapes.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "layout/base/floating_point_state.hpp"
#include "layout/base/heading.hpp"
#include "layout/base/rounding.hpp"
#include "layout/base/shortest.hpp"
#include "layout/hierarchy/discs.hpp"

namespace bch {
namespace {

/// What rounding corners to float may move them by, times their distance from the origin, and to spare.
constexpr double corner_rounding = 0x1p-22;
constexpr int max_corners = 6144;  ///< 6 * 2^10

/// A capsule as numbers to compute with.
struct ExactCapsule {
  double ax, ay, bx, by, radius;

  explicit ExactCapsule(const Capsule& of)
      : ax(of.a.x), ay(of.a.y), bx(of.b.x), by(of.b.y), radius(of.radius) {}
  bool is_valid() const { return radius > 0 && max_extent() <= detail::rounding::largest_extent; }
  /// Returns the largest distance of a point from the origin, at least.
  double max_extent() const {
    return std::max(std::abs(ax) + std::abs(ay), std::abs(bx) + std::abs(by)) + radius;
  }
};

/// Returns a polygon about a capsule: half a regular polygon, circumscribed, about each end. Corners of n of them are 1 / cos(pi / n) of the radius
/// away from the end.
std::vector<Vec2> polygon_about(const ExactCapsule& capsule, double tolerance) {
  const double spare = corner_rounding * capsule.max_extent(), radius = capsule.radius + spare;
  const auto excess = [&](int corners) {
    const detail::Rotation half = detail::rotation(std::numbers::pi / corners);
    return radius * (1 / half.cosine - 1) + 2 * spare;
  };
  int corners = 6;
  while (corners < max_corners && excess(corners) > tolerance) corners *= 2;
  if (excess(corners) > tolerance) return {};
  const double x = capsule.bx - capsule.ax, y = capsule.by - capsule.ay, length = std::sqrt(x * x + y * y);
  const double u = length > 0 ? x / length : 1, v = length > 0 ? y / length : 0;
  const double outer = radius / detail::rotation(std::numbers::pi / corners).cosine * (1 + 1e-9);
  std::vector<Vec2> points;
  // Sides of the polygon lie along the capsule's own, so that both ends together have the corners of one, in its order.
  for (int i = 0; i < corners; ++i) {
    const detail::Rotation turn =
        detail::rotation(2 * std::numbers::pi * (i + 0.5) / corners - std::numbers::pi / 2);
    const bool at_b = 2 * i < corners;
    const double dx = outer * (turn.cosine * u - turn.sine * v),
                 dy = outer * (turn.cosine * v + turn.sine * u);
    points.push_back({static_cast<float>((at_b ? capsule.bx : capsule.ax) + dx),
                      static_cast<float>((at_b ? capsule.by : capsule.ay) + dy)});
  }
  return points;
}

}  // namespace

Shape shape_from_discs(std::span<const Disc> discs) {
  const detail::FloatingPointStateGuard floats;
  // In braces after an outline, GCC 12 destroys the outline twice where this throws.
  Shape shape;
  shape.hierarchy = detail::disc_hierarchy(discs);
  return shape;
}

Shape shape_from_polygons(std::span<const std::vector<Vec2>> polygons, float threshold) {
  const detail::FloatingPointStateGuard floats;
  Shape shape;
  shape.outline = outline_from_polygons(polygons);
  shape.hierarchy = contour_hierarchy(shape.outline, threshold);
  return shape;
}

Shape shape_from_capsules(std::span<const Capsule> capsules, float tolerance, float threshold) {
  const detail::FloatingPointStateGuard floats;
  if (!(tolerance > 0))
    throw std::invalid_argument("shape: expected a tolerance above 0 m, found " +
                                detail::shortest(tolerance));
  std::vector<std::vector<Vec2>> polygons;
  for (std::size_t i = 0; i < capsules.size(); ++i) {
    const auto reject = [&](const std::string& why) {
      throw std::invalid_argument("shape: capsule " + std::to_string(i) + why);
    };
    const ExactCapsule capsule(capsules[i]);
    if (!capsule.is_valid())
      reject(": expected a radius above 0 m and an extent of at most 1e6 m, found a radius of " +
             detail::shortest(capsules[i].radius));
    polygons.push_back(polygon_about(capsule, double{tolerance}));
    if (polygons.back().empty())
      reject(": expected a larger tolerance for its size, found " + detail::shortest(tolerance) + " m");
  }
  if (capsules.empty()) throw std::invalid_argument("shape: expected at least one capsule, found none");
  return shape_from_polygons(polygons, threshold);
}

}  // namespace bch
