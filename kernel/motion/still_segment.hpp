// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>

#include "kernel/motion/moving_disc.hpp"

namespace bch::detail {

/// Represents a segment that stands still: its ends, the unit vector from the one to the other, its length, and what its coordinates are
/// off by.
struct StillSegment {
  double ax, ay, bx, by;
  double x, y, length;
  double slack;
};

/// Holds the times of 0 to `last` at which all of some linear functions are not below 0.
class TimesAbove {
 public:
  explicit TimesAbove(double last) noexcept : end_(last) {}

  void keep(double value, double growth) noexcept {
    if (value < 0)
      begin_ = std::max(begin_, growth > 0 ? -value / growth : never);
    else if (growth < 0)
      end_ = std::min(end_, value / -growth);
  }
  double first() const noexcept { return begin_ <= end_ ? begin_ : never; }

 private:
  double begin_ = 0, end_;
};

/// Returns the first time from 0 to `last` at which a disc is at most `room` from a segment, or never: from one of the ends, or from the
/// line, where its centre is beside the segment.
///
/// Rounding: when the centre comes beside the segment is off by what its coordinates are. It is next to an end then, as near as to
/// the line but for less than the room.
inline double first_overlap(const MovingDisc& disc, const StillSegment& segment, double room,
                            double last) noexcept {
  const double at_x = disc.x - segment.ax, at_y = disc.y - segment.ay, radius = disc.radius + room;
  const double along = at_x * segment.x + at_y * segment.y, across = segment.x * at_y - segment.y * at_x;
  const double along_way = disc.way_x * segment.x + disc.way_y * segment.y,
               across_way = segment.x * disc.way_y - segment.y * disc.way_x;
  TimesAbove beside(last);
  beside.keep(radius - across, disc.growth - across_way);
  beside.keep(radius + across, disc.growth + across_way);
  if (beside.first() == never) return never;
  beside.keep(along, along_way);
  beside.keep(segment.length - along, -along_way);
  const MovingDisc from{segment.ax, segment.ay, 0, 0, 0, 0}, to{segment.bx, segment.by, 0, 0, 0, 0};
  return std::min(
      {beside.first(), first_overlap(disc, from, room, last), first_overlap(disc, to, room, last)});
}

}  // namespace bch::detail
