// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/base/placed_shape.hpp"

#include <algorithm>

#include "bench/base/disc_union_area.hpp"

namespace bch::cli {

Pixel Placement::operator()(Vec2 point) const {
  const double x = static_cast<double>(point.x), y = static_cast<double>(point.y);
  // The picture's y axis points down.
  return {origin.x + scale * (cosine * x - sine * y), origin.y - scale * (sine * x + cosine * y)};
}

void Bounds::add(const Disc& disc) {
  const double x = static_cast<double>(disc.x), y = static_cast<double>(disc.y);
  const double r = static_cast<double>(disc.radius);
  left = std::min(left, x - r), right = std::max(right, x + r);
  low = std::min(low, y - r), high = std::max(high, y + r);
}

double Bounds::scale(double side) const {
  return 0.94 * side / std::max(right - left, high - low);
}

Placement Bounds::placement(Pixel corner, double side) const {
  const double s = scale(side);
  return {
      {corner.x + side / 2 - s * (left + right) / 2, corner.y + side / 2 + s * (low + high) / 2}, 1, 0, s};
}

PixelDisc placed(const Placement& placement, const Sphere& sphere) {
  return {placement(Vec2{sphere.x, sphere.y}), placement.scale * static_cast<double>(sphere.radius),
          placement.scale * static_cast<double>(sphere.z)};
}

PixelDisc placed(const Placement& placement, const Disc& disc) {
  return placed(placement, Sphere{disc.x, disc.y, 0, disc.radius});
}

std::vector<PixelDisc> placed_cut(const Placement& placement, const Hierarchy& hierarchy,
                                  std::uint32_t depth) {
  std::vector<PixelDisc> discs;
  for (const Disc& disc : discs_of(hierarchy, depth)) discs.push_back(placed(placement, disc));
  return discs;
}

bool overlap(const PixelDisc& a, const PixelDisc& b) {
  const double x = a.centre.x - b.centre.x, y = a.centre.y - b.centre.y, z = a.height - b.height,
               r = a.radius + b.radius;
  return x * x + y * y + z * z <= r * r;
}

std::vector<PixelDisc> visible(const std::vector<PixelDisc>& discs) {
  const auto covers = [](const PixelDisc& a, const PixelDisc& b) {
    const double x = a.centre.x - b.centre.x, y = a.centre.y - b.centre.y, more = a.radius - b.radius;
    return more > 0 && x * x + y * y <= more * more;
  };
  std::vector<PixelDisc> seen;
  for (const PixelDisc& disc : discs)
    if (std::none_of(discs.begin(), discs.end(), [&](const PixelDisc& other) { return covers(other, disc); }))
      seen.push_back(disc);
  return seen;
}

double round_length(double most) {
  double length = 1e-6;
  for (double decade = 1e-6; decade < 1e7; decade *= 10)
    for (const double step : {1.0, 2.0, 5.0})
      if (step * decade <= most) length = step * decade;
  return length;
}

void draw_outline(Svg& svg, const Placement& placement, const Outline& outline) {
  svg.begin_path();
  std::vector<Pixel> points;
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    points.clear();
    for (const Vec2 point : outline.contour(c)) points.push_back(placement(point));
    svg.add_closed_curve(points);
  }
  svg.end_path();
}

void draw_discs(Svg& svg, const std::vector<PixelDisc>& discs) {
  for (const PixelDisc& disc : discs) svg.circle(disc.centre, disc.radius);
}

}  // namespace bch::cli
