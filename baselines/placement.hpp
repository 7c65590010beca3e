// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>

#include <bch/agents.hpp>
#include <bch/geometry.hpp>

#include "layout/base/heading.hpp"

namespace bch::baselines {

/// Holds the placement of the agent with the larger index in the frame of the other one, in float. It uses
/// the operations that layout/base/rounding.hpp lists. Tests of discs use it.
struct FloatPlacement {
  float cosine, sine, x, y;
  float z = 0;  ///< how much higher it stands
};

FloatPlacement float_placement(const Agents& agents, Pair pair) noexcept;
/// Returns the same by the directions of all agents' headings.
FloatPlacement float_placement(const Agents& agents, Pair pair,
                               std::span<const detail::UnitVector> directions) noexcept;

/// Represents a point of the ground plane in double.
struct Point2 {
  double x = 0, y = 0;
};

inline Point2 exact(Vec2 p) noexcept {
  return {static_cast<double>(p.x), static_cast<double>(p.y)};
}

/// Holds the placement in double, for tests of triangles and segments. A point of the second shape is placed
/// by place() and rounded to double there. Those doubles, together with the floats of the first shape, ARE the input
/// of the exact tests: each has one right answer for them, however the structures arrive at it. Against exact
/// arithmetic with the exact headings a placed point is off by 6e-10 of its distance from its agent, which is
/// the error of layout/base/heading.hpp, and by 4 units in the last place of the distance between the agents.
struct Placement {
  double cosine = 1, sine = 0, x = 0, y = 0;
  double z = 0;  ///< how much higher it stands, for tests in space

  Point2 place(double at_x, double at_y) const noexcept {
    return {x + (cosine * at_x - sine * at_y), y + (sine * at_x + cosine * at_y)};
  }
  Point2 place(Vec2 p) const noexcept { return place(static_cast<double>(p.x), static_cast<double>(p.y)); }
};

/// Returns the placement of a pair. Parts below 2^-100 become zero, so every coordinate of a placed point is
/// a multiple of 2^-301 (a float is one of 2^-149), and no product of three of them underflows in the exact
/// tests.
Placement placement(const Agents& agents, Pair pair) noexcept;
/// Returns the same with Agents::z.
Placement placement_in_space(const Agents& agents, Pair pair) noexcept;

}  // namespace bch::baselines
