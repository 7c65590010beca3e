// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/format/outline.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "layout/base/rounding.hpp"
#include "layout/base/shortest.hpp"

namespace bch {
namespace {

double twice_area(std::span<const Vec2> contour) {
  double sum = 0;
  for (std::size_t i = 0, before = contour.size() - 1; i < contour.size(); before = i++)
    sum += static_cast<double>(contour[before].x) * static_cast<double>(contour[i].y) -
           static_cast<double>(contour[before].y) * static_cast<double>(contour[i].x);
  return sum;
}

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
    if (!std::isfinite(points[i].x) || !std::isfinite(points[i].y))
      throw std::invalid_argument("outline: point " + std::to_string(i) + " is not finite");
}

/// Whiskers and contours of a few grid steps have no area, or by the rounding of their points to the grid and of the sum
/// less than none: only what is not explained by that is clockwise.
void require_not_clockwise(const Outline& outline, std::size_t c, double twice_area, double reach) {
  const auto contour = outline.contour(c);
  const auto count = static_cast<double>(contour.size());
  if (twice_area >= -0x1p-52 * count * count * reach * reach) return;
  const double by_grid =
      2 * rounding::outline_grid_steps * static_cast<double>(outline.grid_step) * length(contour);
  if (twice_area >= -by_grid) return;
  throw std::invalid_argument("outline: contour " + std::to_string(c) + " is clockwise, its area " +
                              shortest(0.5 * twice_area) + " m^2");
}

}  // namespace

double reach(std::span<const Vec2> points) {
  double square = 0;
  for (const Vec2& p : points) {
    const double x = p.x, y = p.y;
    square = std::max(square, x * x + y * y);
  }
  return std::sqrt(square) * (1 + 0x1p-50);
}

double area(const Outline& outline) {
  double twice = 0;
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    const auto points = outline.contour(c);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec2 a = points[i], b = points[(i + 1) % points.size()];
      twice += static_cast<double>(a.x) * static_cast<double>(b.y) -
               static_cast<double>(a.y) * static_cast<double>(b.x);
    }
  }
  return 0.5 * twice;
}

std::span<const Vec2> largest_contour(const Outline& outline) {
  std::span<const Vec2> largest = outline.contour(0);
  if (outline.contours() == 1) return largest;
  double most = twice_area(largest);
  for (std::size_t c = 1; c < outline.contours(); ++c)
    if (const double size = twice_area(outline.contour(c)); size > most)
      most = size, largest = outline.contour(c);
  return largest;
}

double validate(const Outline& outline) {
  const auto& begin = outline.contour_begin;
  if (begin.size() < 2 || begin.front() != 0 || begin.back() != outline.points.size())
    throw std::invalid_argument("outline: contour offsets do not fit " +
                                std::to_string(outline.points.size()) + " points");
  for (std::size_t c = 0; c + 1 < begin.size(); ++c)
    if (begin[c] >= begin[c + 1])
      throw std::invalid_argument("outline: contour " + std::to_string(c) + " is empty");
  const double size = reach(outline.points);
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    const double area = twice_area(outline.contour(c));
    // What is not finite makes the area so.
    if (!std::isfinite(area)) require_finite(outline.points);
    if (area < 0) require_not_clockwise(outline, c, area, size);
  }
  if (!std::isfinite(outline.grid_step) || outline.grid_step < 0)
    throw std::invalid_argument("outline: grid step " + shortest(outline.grid_step));
  if (size < rounding::smallest_reach || size > rounding::largest_reach)
    throw std::invalid_argument("outline: reach " + shortest(size) + " m is outside 1e-6 to 1e6 m");
  if (static_cast<double>(outline.grid_step) > size)
    throw std::invalid_argument("outline: grid step " + shortest(outline.grid_step) +
                                " m is above the reach, " + shortest(size) + " m");
  return size;
}

}  // namespace bch
