// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "kernel/motion/moving_body.hpp"
#include "layout/base/heading.hpp"
#include "layout/base/plane_point.hpp"
#include "layout/base/ring_edges.hpp"

namespace bch::detail {

/// Represents a body at a time, in its own frame and in the steps of its chunk. Points of the world are seen from its position, metres.
class BodyAt {
 public:
  BodyAt(const MovingBody& body, double time)
      : chunk_(body.chunk()),
        from_(chunk_.key(body.key())),
        to_(chunk_.key(body.key() + 1)),
        share_(body.share(time)),
        pose_(body.pose(time)),
        turn_(rotation(pose_.heading)) {}

  /// Returns whether it holds a ring of another body, or one of its discs where that has no rings; no discs overlap.
  bool holds(const BodyAt& other) const {
    const PlanePoint between{other.pose_.x - pose_.x, other.pose_.y - pose_.y};
    return !chunk_.ring_ends.empty() &&
           other.any_part([&](const PlanePoint& p) { return goes_round(p + between); });
  }

  /// Returns whether the rings go round a point.
  bool goes_round(const PlanePoint& point) const {
    const PlanePoint p = {(turn_.cosine * point.x + turn_.sine * point.y) / chunk_.step,
                          (turn_.cosine * point.y - turn_.sine * point.x) / chunk_.step};
    return length(p - centre(0)) <= mix(from_.radius[0], to_.radius[0]) && winding(p) != 0;
  }

  /// Calls test(p) for a centre of each ring, or of each disc where there are no rings, until one is true. Returns: whether one was.
  template <class Test>
  bool any_part(Test test) const {
    const auto test_disc = [&](std::uint32_t i) {
      const PlanePoint p = centre(chunk_.leaf_of_disc[i]);
      return test(PlanePoint{chunk_.step * (turn_.cosine * p.x - turn_.sine * p.y),
                             chunk_.step * (turn_.sine * p.x + turn_.cosine * p.y)});
    };
    const std::vector<std::uint32_t>& ends = chunk_.ring_ends;
    if (!ends.empty())
      return std::any_of(ends.begin(), ends.end(), [&](std::uint32_t end) { return test_disc(end - 1); });
    for (std::uint32_t i = 0; i < chunk_.leaf_of_disc.size(); ++i)
      if (test_disc(i)) return true;
    return false;
  }

 private:
  double mix(double from, double to) const { return from + (to - from) * share_; }
  PlanePoint centre(std::uint32_t node) const {
    return {mix(from_.x[node], to_.x[node]), mix(from_.y[node], to_.y[node])};
  }

  int winding(const PlanePoint& p) const {
    int winding = 0;
    for_each_ring_edge(chunk_.ring_ends, [&](std::uint32_t i, std::uint32_t next) {
      const std::uint32_t a = chunk_.leaf_of_disc[i], b = chunk_.leaf_of_disc[next];
      if ((mix(from_.y[a], to_.y[a]) <= p.y) == (mix(from_.y[b], to_.y[b]) <= p.y)) return;
      const PlanePoint from = centre(a), to = centre(b);
      const double side = (to.x - from.x) * (p.y - from.y) - (p.x - from.x) * (to.y - from.y);
      if ((side > 0) == (to.y > p.y)) winding += to.y > p.y ? 1 : -1;
    });
    return winding;
  }

  const AnimatedTreeChunk& chunk_;
  NodesAtKey from_, to_;
  double share_;
  PathKey pose_;
  Rotation turn_;
};

}  // namespace bch::detail
