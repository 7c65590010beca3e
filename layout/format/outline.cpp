// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/outline.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "layout/base/floating_point_state.hpp"
#include "layout/base/number_class.hpp"
#include "layout/base/rounding.hpp"
#include "layout/base/shortest.hpp"
#include "layout/format/contours.hpp"

namespace bch {

using namespace detail;

namespace {

/// Returns the length of a contour, metres.
double length(std::span<const Vec2> contour) {
  double sum = 0;
  for (std::size_t i = 0, before = contour.size() - 1; i < contour.size(); before = i++)
    sum += std::hypot(static_cast<double>(contour[i].x) - static_cast<double>(contour[before].x),
                      static_cast<double>(contour[i].y) - static_cast<double>(contour[before].y));
  return sum;
}

void require_finite(std::span<const Vec2> points) {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!is_finite(points[i].x) || !is_finite(points[i].y))
      throw std::invalid_argument("outline: point " + std::to_string(i) + " is not finite");
}

/// Whiskers and contours of a few grid steps have no area, or by the rounding of their points to the grid and of the sum
/// less than none: only what is not explained by that is clockwise.
void require_not_clockwise(const Outline& outline, std::size_t c, double twice_area, double max_extent) {
  const auto contour = outline.contour(c);
  const auto count = static_cast<double>(contour.size());
  if (twice_area >= -0x1p-52 * count * count * max_extent * max_extent) return;
  const double by_grid =
      2 * rounding::outline_grid_steps * static_cast<double>(outline.grid_step) * length(contour);
  if (twice_area >= -by_grid) return;
  throw std::invalid_argument("outline: contour " + std::to_string(c) + " is clockwise, its area " +
                              shortest(0.5 * twice_area) + " m^2");
}

}  // namespace

double area(const Outline& outline) {
  const FloatingPointStateGuard floats;
  double twice = 0;
  for (std::size_t c = 0; c < outline.contours(); ++c) twice += twice_area(outline.contour(c));
  return 0.5 * twice;
}

Outline outline_from_polygons(std::span<const std::vector<Vec2>> polygons) {
  const FloatingPointStateGuard floats;
  if (polygons.empty()) throw std::invalid_argument("outline: there are no polygons");
  Outline outline;
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    const std::string name = "polygon " + std::to_string(p);
    const auto begin = static_cast<std::ptrdiff_t>(outline.points.size());
    for (const Vec2& corner : polygons[p]) {
      if (!is_finite(corner.x) || !is_finite(corner.y))
        throw std::invalid_argument(name + ": corner " + std::to_string(&corner - polygons[p].data()) +
                                    " is not finite");
      if (std::ssize(outline.points) == begin || outline.points.back() != corner)
        outline.points.push_back(corner);
    }
    while (std::ssize(outline.points) > begin + 1 && outline.points.back() == outline.points[begin])
      outline.points.pop_back();
    const auto corners = std::span(outline.points).subspan(static_cast<std::size_t>(begin));
    if (corners.size() < 3)
      throw std::invalid_argument(name + ": " + std::to_string(corners.size()) + " different corners");
    const double area = twice_area(corners);
    if (area == 0) throw std::invalid_argument(name + ": it has no area");
    if (area < 0) std::reverse(corners.begin(), corners.end());
    outline.contour_begin.push_back(static_cast<std::uint32_t>(outline.points.size()));
  }
  validate(outline);
  return outline;
}

double validate(const Outline& outline) {
  const FloatingPointStateGuard floats;
  const auto& begin = outline.contour_begin;
  if (begin.size() < 2 || begin.front() != 0 || begin.back() != outline.points.size())
    throw std::invalid_argument("outline: contour offsets do not fit " +
                                std::to_string(outline.points.size()) + " points");
  for (std::size_t c = 0; c + 1 < begin.size(); ++c)
    if (begin[c] >= begin[c + 1])
      throw std::invalid_argument("outline: contour " + std::to_string(c) + " is empty");
  const double size = max_extent(outline.points);
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    const double area = twice_area(outline.contour(c));
    // What is not finite makes the area so.
    if (!is_finite(area)) require_finite(outline.points);
    if (area < 0) require_not_clockwise(outline, c, area, size);
  }
  if (!is_finite(outline.grid_step) || outline.grid_step < 0)
    throw std::invalid_argument("outline: expected a grid step of at least 0 m, found " +
                                shortest(outline.grid_step));
  if (size < rounding::smallest_extent || size > rounding::largest_extent)
    throw std::invalid_argument("outline: expected an extent of 1e-6 to 1e6 m, found " + shortest(size));
  if (static_cast<double>(outline.grid_step) > size)
    throw std::invalid_argument("outline: expected a grid step of at most the extent, " + shortest(size) +
                                " m, found " + shortest(outline.grid_step));
  return size;
}

}  // namespace bch
