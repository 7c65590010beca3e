// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/page/page_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "kernel/recordings/page/embedding.hpp"
#include "layout/base/base64.hpp"
#include "layout/base/text.hpp"

namespace bch::detail {
namespace {

std::int16_t millimetres(float metres) {
  return rounded<std::int16_t>(static_cast<double>(metres) * 1000);
}

/// Returns the distance of a point from a segment, millimetres.
double distance(ShapePoint point, ShapePoint a, ShapePoint b) {
  const double dx = b.x - a.x, dy = b.y - a.y, px = point.x - a.x, py = point.y - a.y;
  const double length2 = dx * dx + dy * dy;
  const double along = length2 > 0 ? std::clamp((px * dx + py * dy) / length2, 0.0, 1.0) : 0;
  return std::hypot(px - along * dx, py - along * dy);
}

struct Range {
  std::size_t first, last;
};

/// Marks the points between the ends of a range that it takes to describe it.
void mark_needed(const std::vector<ShapePoint>& points, Range whole, std::vector<char>& needed) {
  // Rounding to millimetres has moved each point by up to 0.71 before.
  constexpr double tolerance = outline_tolerance - 0.75;
  std::vector<Range> open{whole};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    double farthest = tolerance;
    std::size_t at = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double d = distance(points[i], points[first], points[last]);
      if (d > farthest) {
        farthest = d;
        at = i;
      }
    }
    if (at == first) continue;
    needed[at] = 1;
    open.push_back({first, at});
    open.push_back({at, last});
  }
}

}  // namespace

std::vector<ShapePoint> simplified(const std::vector<Vec2>& contour) {
  std::vector<ShapePoint> points;
  for (const Vec2 point : contour) {
    const ShapePoint next{millimetres(point.x), millimetres(point.y)};
    if (points.empty() || points.back() != next) points.push_back(next);
  }
  if (points.size() < 3) return points;
  // The curve is cut at its first point and at the one farthest from that.
  const auto from_first = [&](ShapePoint p) { return std::hypot(p.x - points[0].x, p.y - points[0].y); };
  const auto farthest = std::ranges::max_element(points, {}, from_first);
  const auto middle = static_cast<std::size_t>(farthest - points.begin());
  const std::size_t end = points.size();
  points.push_back(points.front());
  std::vector<char> needed(points.size(), 0);
  needed[0] = needed[middle] = 1;
  mark_needed(points, {0, middle}, needed);
  mark_needed(points, {middle, end}, needed);
  std::vector<ShapePoint> kept;
  for (std::size_t i = 0; i < end; ++i)
    if (needed[i]) kept.push_back(points[i]);
  return kept;
}

void PageShapes::add(const PageShape& shape) {
  names_.push_back(printable_line(shape.name));
  name_bytes_ += names_.back().size();
  for (const auto& contour : shape.contours) {
    const auto points = simplified(contour);
    points_.insert(points_.end(), points.begin(), points.end());
    points_begin_.push_back(static_cast<std::uint32_t>(points_.size()));
  }
  contours_begin_.push_back(static_cast<std::uint32_t>(points_begin_.size() - 1));
  for (const Disc& disc : shape.discs)
    discs_.insert(discs_.end(), {millimetres(disc.x), millimetres(disc.y), millimetres(disc.radius)});
  discs_begin_.push_back(static_cast<std::uint32_t>(discs_.size() / 3));
}

std::size_t PageShapes::block_size() const {
  constexpr std::size_t tags = 500, quotes = 3;
  const std::size_t offsets = contours_begin_.size() + points_begin_.size() + discs_begin_.size();
  return base64_size(4 * (offsets + points_.size()) + 2 * discs_.size()) + tags + name_bytes_ +
         quotes * size();
}

std::string PageShapes::blocks() const {
  std::string out = number_block("contours-begin", contours_begin_);
  out += number_block("points-begin", points_begin_);
  out += number_block("points", "i16", std::as_bytes(std::span(points_)));
  return out + number_block("discs-begin", discs_begin_) + number_block("discs", discs_);
}

}  // namespace bch::detail
