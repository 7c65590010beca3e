// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/animation/parts_apart.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>

#include "layout/animation/contour.hpp"
#include "layout/base/rounding.hpp"

namespace bch::detail {
namespace {

/// The corners of a triangle at a key.
using Corners = std::array<Vec2, 3>;

/// Returns whether a triangle is too small for an outline of its own, which has to have a reach, and whose grid is
/// no coarser than that of an outline it is in.
bool is_point(const Corners& corners, double grid_step) {
  constexpr double least = 4 * rounding::smallest_reach;
  const auto extent = [&](float Vec2::*axis) {
    const auto [low, high] = std::minmax({corners[0].*axis, corners[1].*axis, corners[2].*axis});
    return double{high} - double{low};
  };
  return std::max(extent(&Vec2::x), extent(&Vec2::y)) < std::max(least, 2 * grid_step);
}

/// Returns the contour that goes round a triangle, or the nearest one to its middle.
std::size_t contour_round(const Corners& corners, const Outline& outline) {
  if (outline.contours() == 1) return 0;
  const auto& [a, b, c] = corners;
  const PlanePoint middle = (1.0 / 3) * (plane_point(a) + plane_point(b) + plane_point(c));
  std::size_t found = 0;
  double deepest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.contours(); ++i)
    if (const double depth = depth_in(outline.contour(i), middle); depth > deepest) {
      deepest = depth;
      found = i;
    }
  return found;
}

}  // namespace

std::vector<TriangleList> parts_apart(const TriangleList& triangles, std::span<const KeyPose> keys,
                                      std::span<const Outline> outlines) {
  const auto is_one = [](const Outline& outline) { return outline.contours() == 1; };
  if (std::all_of(outlines.begin(), outlines.end(), is_one)) return {};
  std::map<std::vector<std::size_t>, TriangleList> by_contours;
  std::vector<std::size_t> contours;
  for (const auto& [a, b, c] : triangles) {
    contours.clear();
    for (std::size_t k = 0; k < keys.size(); ++k) {
      const std::vector<Vec2>& at = keys[k].vertices;
      const Corners corners = {at[a], at[b], at[c]};
      if (is_point(corners, double{outlines[k].grid_step})) break;
      contours.push_back(contour_round(corners, outlines[k]));
    }
    if (contours.size() == keys.size()) by_contours[contours].push_back({a, b, c});
  }
  std::vector<TriangleList> parts;
  if (by_contours.size() > 1)
    for (auto& [of, part] : by_contours) parts.push_back(std::move(part));
  return parts;
}

}  // namespace bch::detail
