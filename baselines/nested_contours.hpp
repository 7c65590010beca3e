// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bch/agents.hpp>
#include <bch/geometry.hpp>
#include <bch/outline.hpp>

#include "baselines/placement.hpp"

namespace bch::baselines {

/// Finds whether a contour of one agent lies inside a contour of another one, for outlines that do not meet. It is written to be
/// fast: enclosing discs settle most pairs, and else one point does, which is apart from the other outline by more than
/// double rounds (layout/base/rounding.hpp).
class NestedContours {
 public:
  /// Adds the outline of the next shape.
  void add(const Outline& outline);

  /// `place` is the placement of the pair, as float_placement() gives it.
  bool query(const Agents& agents, Pair pair, const FloatPlacement& place) const noexcept;

 private:
  struct Contour {
    Point2 centre;  ///< of the smallest enclosing disc
    double radius;
    double slack;              ///< what a placement in float is off by at most, of a point of the contour
    std::uint32_t begin, end;  ///< its points
  };

  std::span<const Contour> contours_of(std::uint32_t shape) const noexcept;
  static bool one_may_be_inside(const Contour& a, const Contour& b, Point2 b_centre) noexcept;
  bool contains(const Contour& outer, Point2 point) const noexcept;

  std::vector<Vec2> points_;
  std::vector<Contour> contours_;
  std::vector<std::uint32_t> begin_ = {0};  ///< per shape: its contours; then contours_.size()
};

}  // namespace bch::baselines
