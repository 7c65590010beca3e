// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "baselines/placement.hpp"
#include "layout/base/rounding.hpp"

/// Declares the test of exact leaves. It computes in double with the operations of layout/base/rounding.hpp, V, in their
/// order. It is written independently of the kernel, which has to give the same bits.
namespace bch::baselines {

using Segment = std::array<Point2, 2>;

/// Tells the relation of two segments.
enum class Meeting : std::uint8_t {
  none,
  within_margin,  ///< they come within the margin of each other
  sure,           ///< also, their outlines surely cross, so that some leaves overlap with all ancestors
};

inline Point2 minus(Point2 a, Point2 b) noexcept {
  return {a.x - b.x, a.y - b.y};
}

/// The sides of a segment's line on which two points lie: one value each, and the least value of a point at a
/// distance of one margin from the line.
struct Sides {
  double first, second, margin;

  Sides(const Segment& of, const Segment& points, double distance) noexcept {
    const Point2 edge = minus(of[1], of[0]);
    const auto side = [&](Point2 point) {
      const Point2 to = minus(point, of[0]);
      return edge.x * to.y - edge.y * to.x;
    };
    first = side(points[0]), second = side(points[1]);
    margin = distance * (std::abs(edge.x) + std::abs(edge.y));
  }

  bool on_one_side() const noexcept {
    return std::min(first, second) > margin || std::max(first, second) < -margin;
  }
  bool on_both_sides() const noexcept {
    const double sure = detail::rounding::sure_fraction * margin;
    return std::max(first, second) > sure && std::min(first, second) < -sure;
  }
};

inline double square_distance(Point2 point, const Segment& segment) noexcept {
  const Point2 edge = minus(segment[1], segment[0]), to = minus(point, segment[0]);
  const double square = edge.x * edge.x + edge.y * edge.y;
  double t = 0;
  if (square > 0) t = std::clamp((to.x * edge.x + to.y * edge.y) / square, 0.0, 1.0);
  const double x = to.x - t * edge.x, y = to.y - t * edge.y;
  return x * x + y * y;
}

inline double square_of_ends(const Segment& p, const Segment& q) noexcept {
  return std::min({square_distance(p[0], q), square_distance(p[1], q), square_distance(q[0], p),
                   square_distance(q[1], p)});
}

/// Returns whether two segments come within a margin of each other, and whether they surely cross.
inline Meeting meeting(const Segment& p, const Segment& q, double margin) noexcept {
  const Sides of_p(p, q, margin);
  if (of_p.on_one_side()) return Meeting::none;
  const Sides of_q(q, p, margin);
  if (of_q.on_one_side()) return Meeting::none;
  if (of_p.on_both_sides() && of_q.on_both_sides()) return Meeting::sure;
  return square_of_ends(p, q) <= margin * margin ? Meeting::within_margin : Meeting::none;
}

}  // namespace bch::baselines
