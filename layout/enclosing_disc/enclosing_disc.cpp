// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/enclosing_disc/enclosing_disc.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "layout/enclosing_disc/disc_pivoting.hpp"

namespace bch::detail {
namespace {

using pivoting::Point;

Point widened(Vec2 p) {
  return {p.x, p.y};
}

Point farthest(std::span<const Vec2> points, Point from) {
  std::size_t index = 0;
  double largest = -1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double d = pivoting::square_distance(widened(points[i]), from);
    index = d > largest ? i : index;
    largest = d > largest ? d : largest;
  }
  return widened(points[index]);
}

}  // namespace

EnclosingDisc smallest_enclosing_disc(std::span<const Vec2> points) {
  assert(!points.empty());
  const Point best =
      pivoting::smallest_centre(widened(points[0]), [&](Point from) { return farthest(points, from); });
  const Vec2 centre{static_cast<float>(best.x), static_cast<float>(best.y)};
  double square = 0;
  for (const Vec2 p : points)
    square = std::max(square, pivoting::square_distance(widened(p), widened(centre)));
  return {centre, std::sqrt(square)};
}

}  // namespace bch::detail
