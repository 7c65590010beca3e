// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>
#include <vector>

#include <bch/agents.hpp>
#include <bch/outline.hpp>

namespace bch::baselines {

/// Holds the placement of agent b in the frame of agent a, in x87 extended precision with 64 bits of
/// mantissa. It is off by less than 1e-17 of the distances involved, while the kernels' slack is 1e-6 of
/// them.
struct ExactPlacement {
  long double cosine, sine, x, y;
};

ExactPlacement exact_placement(const Agents& agents, std::uint32_t a, std::uint32_t b);

/// Finds the true relation of two outlines, independent of discs: it compares every segment with every
/// segment, in long double.
class Oracle {
 public:
  Oracle(const Outline& a, const Outline& b, const ExactPlacement& b_in_a);

  /// Returns whether the outlines have a point in common.
  bool cross() const;

  /// Returns whether a contour of one lies inside the other. The outlines must not cross.
  bool nested() const;

  /// Returns the least t in [0, 1] at which the outlines have a point in common if a has moved by t (x, y),
  /// in its own frame; or infinity. Every corner along its displacement against every segment.
  long double time_of_impact(long double x, long double y) const;

  /// Returns the smallest distance between points of the outlines, metres; 0 where they cross.
  long double distance() const;

 private:
  struct Point {
    long double x, y;
  };
  using Contour = std::vector<Point>;

  static bool segments_meet(Point a, Point b, Point p, Point q);
  static long double distance(Point p, Point a, Point b);
  static long double arrival(Point p, long double x, long double y, Point a, Point b);
  static bool inside(Point p, const std::vector<Contour>& contours);

  std::vector<Contour> a_, b_;
};

}  // namespace bch::baselines
