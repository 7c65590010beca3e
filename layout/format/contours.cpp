// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/format/contours.hpp"

#include <algorithm>
#include <cmath>

namespace bch::detail {

double max_extent(std::span<const Vec2> points) {
  double square = 0;
  for (const Vec2& p : points) {
    const double x = p.x, y = p.y;
    square = std::max(square, x * x + y * y);
  }
  return std::sqrt(square) * (1 + 0x1p-50);
}

double twice_area(std::span<const Vec2> contour) {
  double sum = 0;
  for (std::size_t i = 0, before = contour.size() - 1; i < contour.size(); before = i++)
    sum += static_cast<double>(contour[before].x) * static_cast<double>(contour[i].y) -
           static_cast<double>(contour[before].y) * static_cast<double>(contour[i].x);
  return sum;
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

}  // namespace bch::detail
