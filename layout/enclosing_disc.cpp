// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/enclosing_disc.hpp"

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace bch {
namespace {

struct Point {
  double x, y;
};

struct Circle {
  Point centre;
  double square_radius;
};

/// Beyond this share a point counts as outside: tighter than the rounding of a circumcentre would pivot in a
/// circle.
constexpr double slack = 1 + 1e-13;
/// Each pivot enlarges the disc; ten suffice in practice. The last scan makes the answer safe even after
/// these.
constexpr int most_pivots = 100;

double square_distance(Point a, Point b) {
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

Circle around(Point a, Point b) {
  const Point middle{0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
  return {middle, std::fmax(square_distance(middle, a), square_distance(middle, b))};
}

/// Circumcircle; of infinite radius where the points are collinear.
Circle around(Point a, Point b, Point c) {
  const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
  const double twice_area = 2 * (bx * cy - by * cx);
  const double b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
  const Point offset{(cy * b2 - by * c2) / twice_area, (bx * c2 - cx * b2) / twice_area};
  return {{a.x + offset.x, a.y + offset.y}, offset.x * offset.x + offset.y * offset.y};
}

/// The at most three points on the boundary, and the disc that they define.
struct Basis {
  std::array<Point, 3> points;
  int size;
  Circle circle;
};

bool holds(const Circle& circle, const Basis& basis) {
  for (int i = 0; i < basis.size; ++i)
    if (!(square_distance(circle.centre, basis.points[i]) <= circle.square_radius * slack)) return false;
  return true;
}

/// The smallest disc over a basis and one more point, which is outside the basis' disc and hence on the new
/// boundary.
Basis pivot(const Basis& basis, Point q) {
  Basis best{{q}, 1, {q, HUGE_VAL}};
  const auto offer = [&](const Basis& candidate) {
    if (candidate.circle.square_radius < best.circle.square_radius && holds(candidate.circle, basis))
      best = candidate;
  };
  for (int i = 0; i < basis.size; ++i) offer({{q, basis.points[i]}, 2, around(q, basis.points[i])});
  for (int i = 0; i < basis.size; ++i)
    for (int j = i + 1; j < basis.size; ++j)
      offer({{q, basis.points[i], basis.points[j]}, 3, around(q, basis.points[i], basis.points[j])});
  return best;
}

std::size_t farthest(std::span<const Vec2> points, Point from) {
  std::size_t index = 0;
  double largest = -1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double d = square_distance({points[i].x, points[i].y}, from);
    if (d > largest) largest = d, index = i;
  }
  return index;
}

}  // namespace

EnclosingDisc smallest_enclosing_disc(std::span<const Vec2> points) {
  assert(!points.empty());
  const auto at = [&](std::size_t i) { return Point{points[i].x, points[i].y}; };
  const Point a = at(farthest(points, at(0)));
  const Point b = at(farthest(points, a));
  Basis basis{{a, b}, 2, around(a, b)};
  for (int i = 0; i < most_pivots; ++i) {
    const Point q = at(farthest(points, basis.circle.centre));
    if (square_distance(q, basis.circle.centre) <= basis.circle.square_radius * slack) break;
    const Basis next = pivot(basis, q);
    if (!(next.circle.square_radius > basis.circle.square_radius) || std::isinf(next.circle.square_radius))
      break;
    basis = next;
  }
  const Vec2 centre{static_cast<float>(basis.circle.centre.x), static_cast<float>(basis.circle.centre.y)};
  const Point stored{centre.x, centre.y};
  return {centre, std::sqrt(square_distance(at(farthest(points, stored)), stored))};
}

}  // namespace bch
