// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cmath>

#include "kernel/motion/moving_body.hpp"
#include "layout/base/heading.hpp"

namespace bch::detail {

/// Says how far a body reaches in a direction of the world through an interval of time, from its position, times the direction's length: at
/// both ends, and by how much more than what lies evenly between these at most.
///
/// Derivation: in the body's frame it reaches E(d, s) in direction d at a share s of the interval, at most, linear in s. It turns from
/// R0 to R1, and a vector turned at s is at most turn^2 / 8 of its length away from (1 - s) of what it is turned by R0 and s of
/// what by R1. So it reaches (1 - s) E(d0, s) + s E(d1, s) + turn^2 / 8 reach, where d0 and d1 are the direction as the body sees it at
/// both ends. The first two are s (1 - s) (E(d0, 1) - E(d0, 0) - E(d1, 1) + E(d1, 0)) more than what lies evenly between E(d0, 0) and
/// E(d1, 1).
struct ReachAlong {
  double from, to, more;

  /// Takes a body in a window of chunks in which the interval lies, and the direction.
  ReachAlong(const MovingBody& body, unsigned level, const PathKey& begin, const PathKey& end,
             const PlanePoint& direction) noexcept {
    const HullWindow& hull = body.hull(level);
    const double step = body.tree().hulls.step, share = body.hull_share(begin.time, level),
                 share_at_end = body.hull_share(end.time, level), turn = end.heading - begin.heading;
    const auto seen = [&](double heading) {
      const Rotation r = rotation(heading);
      return HullDirection(
          {r.cosine * direction.x + r.sine * direction.y, r.cosine * direction.y - r.sine * direction.x});
    };
    const HullDirection::Extent first = seen(begin.heading).extent(hull);
    const double growth = first.to - first.from;
    from = step * (first.from + growth * share);
    to = step * (first.from + growth * share_at_end), more = 0;
    if (turn == 0) return;
    const HullDirection::Extent last = seen(end.heading).extent(hull);
    const double growth_of_last = last.to - last.from;
    to = step * (last.from + growth_of_last * share_at_end);
    more = std::max(0.0, step * (growth - growth_of_last) * (share_at_end - share)) / 4 +
           turn * turn / 8 * body.tree().reach * length(direction);
  }
};

}  // namespace bch::detail
