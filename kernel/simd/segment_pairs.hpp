// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "kernel/simd/transform.hpp"
#include "layout/base/rounding.hpp"
#include "layout/format/shape_set_view.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Geometry of two segments in double, lane = pair: p of A, and q of B as the floats of a placement put it into A's frame. Every
/// operation is of a fixed sequence, which baselines/ writes down again; layout/base/rounding.hpp, V, derives what they are off by.
template <class Simd>
struct SegmentPair {
  using Double = typename Simd::Double;
  using Point = PointIn<Double>;

  Point p0, p1, q0, q1;

  /// The sides of the line of one segment on which the ends of another lie.
  struct Sides {
    Double high, low;  ///< of both ends, the larger and the smaller
    Double margin;     ///< what counts at least as the margin's distance from the line

    /// Above 0 where both ends are farther than the margin on one side.
    Double beside() const noexcept { return xsimd::max(low, Double(0.0) - high) - margin; }
    /// Above 0 where the ends are surely on different sides.
    Double across() const noexcept {
      return xsimd::min(high, Double(0.0) - low) - Double(rounding::sure_share) * margin;
    }
  };
  Sides sides_of_p(Double margin) const noexcept { return sides(p0, p1, q0, q1, margin); }
  Sides sides_of_q(Double margin) const noexcept { return sides(q0, q1, p0, p1, margin); }

  /// Returns the square of the least distance of an end from the other segment.
  Double square_of_ends() const noexcept {
    return xsimd::min(xsimd::min(square_distance(p0, q0, q1), square_distance(p1, q0, q1)),
                      xsimd::min(square_distance(q0, p0, p1), square_distance(q1, p0, p1)));
  }

 private:
  static Point way(Point from, Point to) noexcept { return {to.x - from.x, to.y - from.y}; }

  static Sides sides(Point from, Point to, Point first, Point second, Double margin) noexcept {
    const Point along = way(from, to), to_first = way(from, first), to_second = way(from, second);
    const Double of_first = along.x * to_first.y - along.y * to_first.x,
                 of_second = along.x * to_second.y - along.y * to_second.x;
    return {xsimd::max(of_first, of_second), xsimd::min(of_first, of_second),
            margin * (xsimd::abs(along.x) + xsimd::abs(along.y))};
  }

  /// Returns the square of the distance from a point to the nearest one of a segment.
  static Double square_distance(Point p, Point from, Point to) noexcept {
    const Point along = way(from, to), to_p = way(from, p);
    // A segment without length has a share of 0, by a number that is less than every other square.
    const Double square = xsimd::max(along.x * along.x + along.y * along.y, Double(1e-300));
    const Double share =
        xsimd::max(xsimd::min((to_p.x * along.x + to_p.y * along.y) / square, Double(1.0)), Double(0.0));
    const Double x = to_p.x - share * along.x, y = to_p.y - share * along.y;
    return x * x + y * y;
  }
};

/// The ends of a register of segments, named by the points where they begin, in registers of doubles.
template <class Simd>
struct SegmentEnds {
  using Double = typename Simd::Double;
  static constexpr std::uint32_t parts =
      Simd::width / Simd::doubles;  ///< registers of doubles for one of floats

  Double end[4][parts];  ///< x and y of the first, then of the second

  static SegmentEnds load(const Vec2* points, const std::uint32_t* begin) noexcept {
    typename Simd::Float of[4];
    Simd::template load_records<2>(&points->x, begin, of);
    SegmentEnds ends;
    for (unsigned i = 0; i < 4; ++i) Simd::widened(of[i], ends.end[i]);
    return ends;
  }

  static SegmentPair<Simd> pair(const SegmentEnds& p, const SegmentEnds& q, const TransformOf<Double>& b_in_a,
                                std::uint32_t part) noexcept {
    return {{p.end[0][part], p.end[1][part]},
            {p.end[2][part], p.end[3][part]},
            b_in_a.apply(q.end[0][part], q.end[1][part]),
            b_in_a.apply(q.end[2][part], q.end[3][part])};
  }
};

}  // namespace bch::detail
