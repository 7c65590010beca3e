// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "kernel/simd/transform.hpp"
#include "layout/format/shape_set_view.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Finds the segments of two outlines that may be within a distance of each other. The *place* of a point is
/// its coordinate along a direction n from A to B. If outlines face each other, few segments have places that
/// are near enough.
///
///     (1) Let |n| <= 1. A segment p of A and a segment q of B are at least (least place of q's ends) -
///         (largest place of p's ends) apart.
///     (2) In float, with n rounded to a length of at most 1 + 4 u, this difference is too large by at most
///         30 u S + 14 u D. The parts: 4 u S + 5 u |d| for the rotated direction and the translation; 4 u S
///         for each of the two places; 2 u (D + 2 S) for the difference; 4 u D for the length of n.
///
/// max_distance() of SegmentGaps covers this error. SegmentGaps explains S and D.
template <class Simd>
class FacingSegments {
 public:
  explicit FacingSegments(const ShapeSetView& shapes) noexcept : shapes_(shapes) {}

  /// Takes two shapes, unless their outlines have too many points, or discs decide about some leaves.
  bool takes(std::uint32_t shape_a, std::uint32_t shape_b) noexcept {
    return shapes_.profiles != nullptr && takes(shape_a, a_) && takes(shape_b, b_);
  }

  /// Finds the segments of these shapes that may be within `distance`, which is at least that of segments `a`
  /// and `b`. The direction is that between the nearest points of a and b. Returns whether the pairs are few.
  bool find(const Transform& b_in_a, std::uint32_t a, std::uint32_t b, float distance) noexcept {
    const auto [x, y] = between(b_in_a, a, b);
    const float length = __builtin_sqrtf(x * x + y * y);
    if (!(length > shortest)) return false;
    const float nx = x / length, ny = y / length;
    // B's places count against n, so that on both sides the largest are the nearest.
    const float largest_a = place(a_, nx, ny, 0);
    const float largest_b = place(b_, -(nx * b_in_a.c + ny * b_in_a.s), nx * b_in_a.s - ny * b_in_a.c,
                                  -(nx * b_in_a.tx + ny * b_in_a.ty));
    least_sum_ = -distance;
    select(a_, least_sum_ - largest_b);
    select(b_, least_sum_ - largest_a);
    return a_.size * b_.size <= max_pairs;
  }

  /// Calls use(a, b) for every pair of the found segments that may be within the distance.
  template <class Use>
  [[gnu::always_inline]] void visit(Use use) const noexcept {
    for (std::uint32_t i = 0; i < a_.size; ++i)
      for (std::uint32_t j = 0; j < b_.size; j += Simd::width) {
        const auto near = Simd::load(b_.end + j) >= Float(least_sum_ - a_.end[i]);
        for (std::uint32_t left = first_lanes(Simd::bits(near), b_.size - j); left != 0; left &= left - 1)
          use(a_.first + a_.found[i],
              b_.first + b_.found[j + static_cast<std::uint32_t>(__builtin_ctz(left))]);
      }
  }

 private:
  using Float = typename Simd::Float;
  using Point = PointIn<float>;
  static constexpr std::uint32_t max_points = 1024, max_pairs = 1024, padding = 16;
  static_assert(padding >= Simd::width);
  static constexpr float shortest = 1e-6f;  ///< metres: a shorter vector is no direction

  /// Holds an outline.
  struct Side {
    const Contour *begin, *end_of_contours;
    std::uint32_t first, count;                     ///< points
    alignas(64) float place[max_points + padding];  ///< of points
    std::uint32_t size;                             ///< the number of segments found
    float end[max_points + padding];                ///< the larger place of an end of each
    std::uint16_t found[max_points + padding];      ///< the points where they begin, from `first` on
  };

  bool takes(std::uint32_t shape, Side& side) const noexcept {
    const ContourRange contours = shapes_.shape_contours[shape];
    side.begin = shapes_.contours + contours.begin, side.end_of_contours = shapes_.contours + contours.end;
    side.first = side.begin->begin;
    side.count = side.end_of_contours[-1].end + 1 - side.first;
    return shapes_.profiles[shape].discs_decide == 0 && side.count <= max_points;
  }

  /// Returns the shortest vector from an end of one segment to the other segment, from A to B.
  Point between(const Transform& b_in_a, std::uint32_t a, std::uint32_t b) const noexcept {
    const auto point = [this](std::uint32_t i) { return Point{shapes_.points[i].x, shapes_.points[i].y}; };
    const auto placed = [&](Point at) { return b_in_a.apply(at.x, at.y); };
    const Point of_a[] = {point(a), point(a + 1)}, of_b[] = {placed(point(b)), placed(point(b + 1))};
    Point shortest{__builtin_inff(), 0};
    for (unsigned k = 0; k < 2; ++k) {
      const Point from_a = way(of_a[k], of_b), from_b = way(of_b[k], of_a);
      if (square(from_a) < square(shortest)) shortest = from_a;
      if (square(from_b) < square(shortest)) shortest = {-from_b.x, -from_b.y};
    }
    return shortest;
  }
  static float square(Point way) noexcept { return way.x * way.x + way.y * way.y; }
  static Point way(Point from, const Point (&to)[2]) noexcept {
    const Point edge{to[1].x - to[0].x, to[1].y - to[0].y}, back{from.x - to[0].x, from.y - to[0].y};
    const float along = back.x * edge.x + back.y * edge.y, length = square(edge);
    const float fraction = along <= 0 ? 0 : along < length ? along / length : 1;
    return {fraction * edge.x - back.x, fraction * edge.y - back.y};
  }

  /// Computes the places of all points. Returns the largest.
  float place(Side& side, float x, float y, float origin) const noexcept {
    const Vec2* const points = shapes_.points + side.first;
    for (std::uint32_t i = 0; i < side.count; ++i) side.place[i] = x * points[i].x + y * points[i].y + origin;
    for (std::uint32_t i = side.count; i % Simd::width != 0; ++i) side.place[i] = side.place[0];
    Float opposite(__builtin_inff());
    for (std::uint32_t i = 0; i < side.count; i += Simd::width)
      opposite = xsimd::min(opposite, Float(0.0f) - Simd::load(side.place + i));
    return -Simd::least(opposite);
  }

  /// Selects the segments with an end at `least` or farther.
  static void select(Side& side, float least) noexcept {
    side.size = 0;
    for (const Contour* contour = side.begin; contour != side.end_of_contours; ++contour) {
      const std::uint32_t end = contour->end - side.first;
      for (std::uint32_t i = contour->begin - side.first; i < end; i += Simd::width) {
        const Float larger = xsimd::max(Simd::load(side.place + i), Simd::load(side.place + i + 1));
        const std::uint32_t bits = first_lanes(Simd::bits(larger >= Float(least)), end - i);
        if (bits != 0) side.size += Simd::compress_indices(bits, i, side.found + side.size);
      }
    }
    for (std::uint32_t k = 0; k < side.size; ++k) {
      const float *const from = side.place + side.found[k], *const to = from + 1;
      side.end[k] = *from < *to ? *to : *from;
    }
  }

  /// Returns the bits of the first `count` lanes.
  static std::uint32_t first_lanes(std::uint32_t bits, std::uint32_t count) noexcept {
    return count < Simd::width ? bits & ((std::uint32_t{1} << count) - 1) : bits;
  }

  const ShapeSetView shapes_;
  Side a_, b_;
  float least_sum_;  ///< of the places of two segments within the distance
};

}  // namespace bch::detail
