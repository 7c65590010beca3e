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

PlanePoint farthest(std::span<const Vec2> points, PlanePoint from) {
  std::size_t index = 0;
  double largest = -1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double d = squared_length(plane_point(points[i]) - from);
    index = d > largest ? i : index;
    largest = d > largest ? d : largest;
  }
  return plane_point(points[index]);
}

}  // namespace

EnclosingDisc smallest_enclosing_disc(std::span<const Vec2> points) {
  assert(!points.empty());
  const PlanePoint best = pivoting::smallest_centre(plane_point(points[0]),
                                                    [&](PlanePoint from) { return farthest(points, from); });
  const Vec2 centre{static_cast<float>(best.x), static_cast<float>(best.y)};
  double square = 0;
  for (const Vec2 p : points) square = std::max(square, squared_length(plane_point(p) - plane_point(centre)));
  return {centre, std::sqrt(square)};
}

}  // namespace bch::detail
