// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <bch/geometry.hpp>

namespace bch::bench {

/// Finds smallest enclosing discs as the textbook does, for comparison of answers and times: expected linear
/// time, by adding points in random order.
/// Source:  E. Welzl, "Smallest enclosing disks (balls and ellipsoids)", 1991; as in de Berg, Cheong, van
///          Kreveld, Overmars, "Computational geometry", 4.7.
class Welzl {
 public:
  struct Circle {
    double x, y, square_radius;
  };

  Circle operator()(std::span<const Vec2> points) {
    points_.assign(points.begin(), points.end());
    shuffle();
    Circle disc = around(points_[0], points_[0]);
    for (std::size_t i = 1; i < points_.size(); ++i)
      if (!contains(disc, points_[i])) disc = through(i, points_[i]);
    return disc;
  }

 private:
  void shuffle() {
    std::uint64_t state = 1;
    for (std::size_t i = points_.size(); i > 1; --i) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      std::swap(points_[i - 1],
                points_[((state >> 32) * i) >> 32]);  // a division would take longer than the rest
    }
  }

  /// Returns the smallest circle around the first `count` points that has one given point on its boundary, or
  /// two.
  Circle through(std::size_t count, Vec2 p) const {
    Circle disc = around(points_[0], p);
    for (std::size_t i = 1; i < count; ++i)
      if (!contains(disc, points_[i])) disc = through(i, p, points_[i]);
    return disc;
  }
  Circle through(std::size_t count, Vec2 p, Vec2 q) const {
    Circle disc = around(p, q);
    for (std::size_t i = 0; i < count; ++i)
      if (!contains(disc, points_[i])) disc = around(p, q, points_[i]);
    return disc;
  }

  static bool contains(const Circle& disc, Vec2 p) {
    const double x = static_cast<double>(p.x) - disc.x, y = static_cast<double>(p.y) - disc.y;
    return x * x + y * y <= disc.square_radius * (1 + 1e-12);
  }

  static Circle around(Vec2 a, Vec2 b) {
    const double x = 0.5 * (static_cast<double>(b.x) - static_cast<double>(a.x)),
                 y = 0.5 * (static_cast<double>(b.y) - static_cast<double>(a.y));
    return {static_cast<double>(a.x) + x, static_cast<double>(a.y) + y, x * x + y * y};
  }
  static Circle around(Vec2 a, Vec2 b, Vec2 c) {
    const double bx = static_cast<double>(b.x) - static_cast<double>(a.x),
                 by = static_cast<double>(b.y) - static_cast<double>(a.y),
                 cx = static_cast<double>(c.x) - static_cast<double>(a.x),
                 cy = static_cast<double>(c.y) - static_cast<double>(a.y);
    const double twice_area = 2 * (bx * cy - by * cx), b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
    const double x = (cy * b2 - by * c2) / twice_area, y = (bx * c2 - cx * b2) / twice_area;
    return {static_cast<double>(a.x) + x, static_cast<double>(a.y) + y, x * x + y * y};
  }

  std::vector<Vec2> points_;
};

}  // namespace bch::bench
