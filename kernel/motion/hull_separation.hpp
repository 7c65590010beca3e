// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cmath>

#include "kernel/motion/moving_body.hpp"
#include "kernel/motion/moving_disc.hpp"
#include "layout/base/heading.hpp"

namespace bch::detail {

/// Bounds how far a body extends in a fixed direction of the world, over an interval of time: the support
/// function about the body's position, times the direction's length. The bound is linear between its values
/// at both ends, plus a bulge.
///
/// Derivation. Let s, from 0 to 1, be the fraction of the interval that has passed. d0 and d1 are the direction
/// in the body's frame at the start and at the end, and `turn` is the angle of rotation in between. The hull
/// (swept 32-DOP) bounds the support in direction d of the body's frame at s by E(d, s), which is linear in s.
///
///     (1) Rotate a vector by s * turn. The result differs from the linear interpolation of both ends,
///         (1 - s) (vector) + s (vector rotated by turn), by at most turn^2 / 8 of the vector's length.
///     (2) So the support is at most (1 - s) E(d0, s) + s E(d1, s) + turn^2 / 8 extent.
///     (3) Compare the first two terms with the linear interpolation between E(d0, 0) and E(d1, 1). They are
///         more by s (1 - s) g, where g = (E(d0, 1) - E(d0, 0)) - (E(d1, 1) - E(d1, 0)).
///     (4) s (1 - s) <= 1/4. So the bulge is at most g / 4 + turn^2 / 8 extent.
///
/// Hulls store E as integers, in multiples of `step_`.
class SupportBound {
 public:
  /// The support at both ends, and the most by which it exceeds linear interpolation.
  struct Extent {
    double from, to, bulge;
  };

  /// The interval lies in the current window of the body's hulls at that level.
  SupportBound(const MovingBody& body, unsigned level, const PathKey& begin, const PathKey& end,
               const PlanePoint& direction) noexcept
      : step_(body.tree().hulls.step),
        fraction_(body.hull_fraction(begin.time, level)),
        fraction_at_end_(body.hull_fraction(end.time, level)),
        turns_(begin.heading != end.heading),
        first_(in_body_frame(direction, begin.heading)),
        last_(turns_ ? in_body_frame(direction, end.heading) : first_) {
    const double turn = end.heading - begin.heading;
    deviation_ = turn * turn / 8 * body.tree().max_extent * length(direction);
  }

  /// Returns the bound for the whole body, or for one of its bands of height, whose extents in the window are
  /// given.
  Extent of(const HullInterval::Extents& extents) const noexcept {
    const HullDirection::Extent first = first_.extent(extents);
    const double growth = first.to - first.from, from = step_ * (first.from + growth * fraction_);
    if (!turns_) return {from, step_ * (first.from + growth * fraction_at_end_), 0};
    const HullDirection::Extent last = last_.extent(extents);
    const double growth_of_last = last.to - last.from;
    return {
        from, step_ * (last.from + growth_of_last * fraction_at_end_),
        std::max(0.0, step_ * (growth - growth_of_last) * (fraction_at_end_ - fraction_)) / 4 + deviation_};
  }

 private:
  static HullDirection in_body_frame(const PlanePoint& direction, double heading) noexcept {
    const Rotation r = rotation(heading);
    return HullDirection(
        {r.cosine * direction.x + r.sine * direction.y, r.cosine * direction.y - r.sine * direction.x});
  }

  double step_, fraction_, fraction_at_end_;
  bool turns_;
  HullDirection first_, last_;  ///< the direction in the body's frame at both ends
  double deviation_ = 0;
};

/// Represents a line that may separate two bodies, and the distance of their positions along it at both ends
/// of the interval.
struct SeparatingLine {
  SupportBound a, b;
  double distance, distance_at_end;

  /// Returns whether two parts, one of each body, are separated throughout the interval.
  bool separates(const HullInterval::Extents& of_a, const HullInterval::Extents& of_b) const noexcept {
    const SupportBound::Extent first = a.of(of_a), second = b.of(of_b);
    const double bulge = first.bulge + second.bulge;
    return distance > first.from + second.from + bulge && distance_at_end > first.to + second.to + bulge;
  }
};

/// Returns whether bands a and b of two bodies overlap in height at some time of an interval. Bands with less than
/// hull_overlap of height in common need not be compared, because neighbouring bands of one body overlap by
/// hull_overlap (animated_hulls.hpp). Here only bands with at most half of it in common count as apart, so that
/// rounding of heights cannot lose a pair. z_a and z_b are the heights of the grounds, and low <= z_a - z_b <= high.
/// Bands overlap if
///
///     min(top_a + high, top_b) - max(bottom_a + low, bottom_b) > hull_overlap / 2
inline bool bands_overlap(std::uint32_t a, std::uint32_t b, double low, double high) noexcept {
  const auto bottom = [](std::uint32_t band) { return band == 0 ? -never : band * hull_band; };
  const auto top = [](std::uint32_t band) { return band + 1 == hull_bands ? never : (band + 1) * hull_band; };
  constexpr double min_overlap = hull_overlap / 2;  // the other half is for rounding
  return std::min(top(a) + high, top(b)) - std::max(bottom(a) + low, bottom(b)) > min_overlap;
}

}  // namespace bch::detail
