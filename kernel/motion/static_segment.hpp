// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>

#include "kernel/motion/moving_disc.hpp"

namespace bch::detail {

/// Represents a fixed segment: its ends, the unit vector from the first to the second, its length, and the
/// error of its coordinates.
struct StaticSegment {
  double ax, ay, bx, by;
  double x, y, length;
  double slack;
};

/// Holds the times in [0, last] at which several linear functions of time are all at least 0.
class NonNegativeTimes {
 public:
  explicit NonNegativeTimes(double last) noexcept : end_(last) {}

  void require_positive(double value, double growth) noexcept {
    if (value < 0)
      begin_ = std::max(begin_, growth > 0 ? -value / growth : never);
    else if (growth < 0)
      end_ = std::min(end_, value / -growth);
  }
  double first() const noexcept { return begin_ <= end_ ? begin_ : never; }

 private:
  double begin_ = 0, end_;
};

/// Returns the first time in [0, last] at which a disc is within `margin` of a segment, or never: within
/// `margin` of one of its ends, or of its line while the centre projects onto the segment.
///
/// Rounding. The time at which the centre begins to project onto the segment is off by as much as the
/// coordinates. The centre is then beside an end of the segment, and its distance from that end differs from
/// its distance from the line by less than the margin.
inline double first_overlap(const MovingDisc& disc, const StaticSegment& segment, double margin,
                            double last) noexcept {
  const double at_x = disc.x - segment.ax, at_y = disc.y - segment.ay, radius = disc.radius + margin;
  const double along = at_x * segment.x + at_y * segment.y, across = segment.x * at_y - segment.y * at_x;
  const double along_move = disc.move_x * segment.x + disc.move_y * segment.y,
               across_move = segment.x * disc.move_y - segment.y * disc.move_x;
  NonNegativeTimes times(last);
  times.require_positive(radius - across, disc.growth - across_move);
  times.require_positive(radius + across, disc.growth + across_move);
  if (times.first() == never) return never;
  times.require_positive(along, along_move);
  times.require_positive(segment.length - along, -along_move);
  const MovingDisc from{segment.ax, segment.ay, 0, 0, 0, 0}, to{segment.bx, segment.by, 0, 0, 0, 0};
  return std::min(
      {times.first(), first_overlap(disc, from, margin, last), first_overlap(disc, to, margin, last)});
}

}  // namespace bch::detail
