// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/outline_checks.hpp"

#include <gtest/gtest.h>

#include "tests/support/plane_geometry.hpp"

namespace bch::test {
namespace {

struct Point {
  double x, y;
};

Point flat(const Vec3& p) {
  return {p.x, p.y};
}
double cross(Point a, Point b, Point p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

}  // namespace

bool inside(const Outline& outline, double x, double y) {
  bool odd = false;
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    const auto contour = outline.contour(c);
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const Point a{contour[i].x, contour[i].y},
          b{contour[(i + 1) % contour.size()].x, contour[(i + 1) % contour.size()].y};
      if ((a.y > y) != (b.y > y)) odd ^= (cross(a, b, {x, y}) > 0) == (b.y > a.y);
    }
  }
  return odd;
}

double distance_to(const Outline& outline, double x, double y) {
  double smallest = HUGE_VAL;
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    const auto contour = outline.contour(c);
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const Vec2 a = contour[i], b = contour[(i + 1) % contour.size()];
      smallest = std::min(smallest, distance_to_segment<double>(x, y, a.x, a.y, b.x, b.y));
    }
  }
  return smallest;
}

void expect_covers(const Outline& outline, Positions positions, Triangles triangles) {
  const double margin = 1.5 * static_cast<double>(outline.grid_step);
  const auto check = [&](Point p) {
    if (inside(outline, p.x, p.y)) return;
    ASSERT_LE(distance_to(outline, p.x, p.y), margin) << p.x << ", " << p.y;
  };
  for (const auto& t : triangles)
    for (int k = 0; k < 3; ++k) {
      const Point a = flat(positions[t[k]]), b = flat(positions[t[(k + 1) % 3]]);
      for (const double s : {0.0, 0.31, 0.74}) check({a.x + s * (b.x - a.x), a.y + s * (b.y - a.y)});
    }
}

}  // namespace bch::test
