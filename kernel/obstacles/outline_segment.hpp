// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <bch/geometry.hpp>

#include "kernel/obstacles/segment.hpp"
#include "kernel/simd/segment_test.hpp"

namespace bch::detail {

/// Compares a segment of an agent's outline with one of an obstacle: whether they meet, and how far apart they are.
/// All in double, in coordinates along the obstacle's segment and perpendicular to it. (`Simd` keeps instruction sets
/// from sharing a function.)
///
///     gap = max(0, s - (m + slack))
///
/// s is the least distance of an end from the other segment, 0 if the segments cross. m is the outline's margin of
/// exact leaves. slack is that of LocalSegment. D is the distance of the outlines.
///
/// The gap is never above D:
///
///   - m bounds the error of the outline's points (rounding.hpp, V, for one shape).
///   - Half of slack bounds the error of the obstacle's segment.
///   - The rounding of s is 2^-51 s. s is at most the distance to the segment's ends plus the extent, so the other half
///     of slack, and m, cover it.
///
/// The gap is below D by at most m, twice slack, and the rounding to float. Let A and B be the distances of the
/// segment's ends from the agent. Then |dx| + |dy| <= sqrt(2) A, and the length is at most A + B, so that
///
///     2 slack = 2^-48 (|dx| + |dy| + length)  <=  2^-48 ((1 + sqrt(2)) A + B)  <=  8.6e-15 (A + B)
///
/// Segments that meet have a gap of 0: meeting is s <= m + slack or a crossing, decided with the same numbers.
template <class Simd>
class OutlineSegment {
 public:
  /// `ends`: those of the outline's segment, in the agent's frame.
  OutlineSegment(const Vec2* ends, const LocalSegment& segment) noexcept
      : segment_(segment), p_(placed(ends[0], segment)), q_(placed(ends[1], segment)) {}

  /// Returns whether both ends are farther than `distance` on one side of the obstacle's line, as most are.
  bool is_off_line(double distance) const noexcept {
    return (p_.y > distance && q_.y > distance) || (p_.y < -distance && q_.y < -distance);
  }

  /// Returns how the segments meet. They do if they cross, or an end of one is within the margin of the other: if
  /// rounding hides a crossing, an end is next to the other segment. A crossing is sure if all ends are farther from
  /// the other's line than the margin, which is far above errors of double.
  Meeting meet(double margin) const noexcept {
    const double limit = margin + segment_.slack;
    if (is_off_line(limit)) return Meeting::none;
    if (!cross()) return square_of_ends() <= limit * limit ? Meeting::within_margin : Meeting::none;
    const double beyond = limit * (__builtin_fabs(q_.x - p_.x) + __builtin_fabs(q_.y - p_.y));
    const bool sure = __builtin_fabs(p_.y) > limit && __builtin_fabs(q_.y) > limit &&
                      __builtin_fabs(side_of(segment_.from)) > beyond &&
                      __builtin_fabs(side_of(segment_.to)) > beyond;
    return sure ? Meeting::sure : Meeting::within_margin;
  }

  /// Returns how far apart they are, metres.
  double gap(double margin) const noexcept {
    if (cross()) return 0;
    const double gap = __builtin_sqrt(square_of_ends()) - (margin + segment_.slack);
    return gap > 0 ? gap : 0;
  }

 private:
  struct Point {
    double x, y;  ///< along and across
  };
  static Point placed(Vec2 end, const LocalSegment& segment) noexcept {
    const double x = end.x, y = end.y;
    return {segment.along(x, y), segment.across(x, y)};
  }

  /// Returns on which side of the outline's line a point of the obstacle's line is, by sign.
  double side_of(double along) const noexcept {
    return (q_.x - p_.x) * -p_.y - (q_.y - p_.y) * (along - p_.x);
  }
  bool cross() const noexcept {
    return (p_.y > 0) != (q_.y > 0) && (side_of(segment_.from) > 0) != (side_of(segment_.to) > 0);
  }

  double square_of_ends() const noexcept {
    const double of_outline = least(square_from_obstacle(p_), square_from_obstacle(q_));
    return least(of_outline, least(square_from_outline(segment_.from), square_from_outline(segment_.to)));
  }
  double square_from_obstacle(Point end) const noexcept {
    const double before = segment_.from - end.x, behind = end.x - segment_.to;
    const double beyond = before < behind ? behind : before;
    return end.y * end.y + (beyond < 0 ? 0 : beyond * beyond);
  }
  double square_from_outline(double along) const noexcept {
    const double x = q_.x - p_.x, y = q_.y - p_.y, to_x = along - p_.x, to_y = -p_.y;
    const double square = x * x + y * y;
    double t = square > 0 ? (to_x * x + to_y * y) / square : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    const double dx = to_x - t * x, dy = to_y - t * y;
    return dx * dx + dy * dy;
  }
  static double least(double a, double b) noexcept { return b < a ? b : a; }

  const LocalSegment& segment_;
  const Point p_, q_;
};

}  // namespace bch::detail
