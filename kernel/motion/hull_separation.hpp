// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cmath>

#include "kernel/motion/moving_body.hpp"
#include "kernel/motion/moving_disc.hpp"
#include "layout/base/heading.hpp"

namespace bch::detail {

/// Says how far a body reaches in a direction of the world through an interval of time, from its position, times the direction's length: at
/// both ends, and by how much more than what lies evenly between these at most.
///
/// Derivation: in the body's frame it reaches E(d, s) in direction d at a fraction s of the interval, at most, linear in s. It turns from
/// R0 to R1, and a vector turned at s is at most turn^2 / 8 of its length away from (1 - s) of what it is turned by R0 and s of
/// what by R1. So it reaches (1 - s) E(d0, s) + s E(d1, s) + turn^2 / 8 reach, where d0 and d1 are the direction as the body sees it at
/// both ends. The first two are s (1 - s) (E(d0, 1) - E(d0, 0) - E(d1, 1) + E(d1, 0)) more than what lies evenly between E(d0, 0) and
/// E(d1, 1).
class SupportBound {
 public:
  /// How far it reaches at both ends, and by how much more between.
  struct Extent {
    double from, to, bulge;
  };

  /// Takes a body in a window of chunks in which the interval lies, and the direction.
  SupportBound(const MovingBody& body, unsigned level, const PathKey& begin, const PathKey& end,
               const PlanePoint& direction) noexcept
      : step_(body.tree().hulls.step),
        fraction_(body.hull_fraction(begin.time, level)),
        fraction_at_end_(body.hull_fraction(end.time, level)),
        turns_(begin.heading != end.heading),
        first_(in_body_frame(direction, begin.heading)),
        last_(turns_ ? in_body_frame(direction, end.heading) : first_) {
    const double turn = end.heading - begin.heading;
    deviation_ = turn * turn / 8 * body.tree().reach * length(direction);
  }

  /// Says that of the whole body, or of one of its bands, in the window.
  Extent of(const HullWindow::Extents& extents) const noexcept {
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
  HullDirection first_, last_;  ///< as the body sees the direction at both ends
  double deviation_ = 0;
};

/// Represents a line along which two bodies are examined, and how far their positions are apart along it at both ends of the interval.
struct SeparatingLine {
  SupportBound a, b;
  double distance, distance_at_end;

  /// Returns whether parts of both are apart all the time.
  bool separates(const HullWindow::Extents& of_a, const HullWindow::Extents& of_b) const noexcept {
    const SupportBound::Extent first = a.of(of_a), second = b.of(of_b);
    const double bulge = first.bulge + second.bulge;
    return distance > first.from + second.from + bulge && distance_at_end > first.to + second.to + bulge;
  }
};

/// Returns whether bands of two bodies have more height in common than the overlap, within an interval in which the first one's ground is
/// from `low` to `high` above the second one's.
inline bool bands_overlap(std::uint32_t a, std::uint32_t b, double low, double high) noexcept {
  const auto bottom = [](std::uint32_t band) { return band == 0 ? -never : band * hull_band; };
  const auto top = [](std::uint32_t band) { return band + 1 == hull_bands ? never : (band + 1) * hull_band; };
  constexpr double min_overlap = hull_overlap / 2;  // the other half is for rounding
  return std::min(top(a) + high, top(b)) - std::max(bottom(a) + low, bottom(b)) > min_overlap;
}

}  // namespace bch::detail
