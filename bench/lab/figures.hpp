// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <bch/shapes.hpp>

#include "bench/base/svg.hpp"

// Figures of the chapters, all of the built-in man and woman seen from above.

namespace bch::lab {

/// Draws the stages of collide() on a pair that only the last one decides.
std::string draw_stages();
/// Draws the distances and the depths of a pair, as lengths.
std::string draw_distances();
/// Draws how a walking man extends in time, the bounds of it, and the intervals of time of a search.
std::string draw_motion();

/// Represents where a person stands. Headings are steps of 1/32 turn: the directions of supports.
struct Stand {
  double x = 0, y = 0;
  unsigned heading = 0;

  double radians() const;
  Vec2 in_world(Vec2 point) const;
  Disc place(const Disc& disc) const;
};

/// Returns the shapes of the man and of the woman, each while walking.
std::vector<Shape> walking_pair();

/// Returns what the outlines of people cover, with a margin.
cli::Bounds bounds_of(std::span<const Shape> shapes, std::span<const Stand> stands);

/// Holds a rectangle of a figure, and the map from the world to it.
struct Panel {
  cli::Pixel corner;
  double side = 0;
  cli::Placement world;

  static Panel of(cli::Pixel corner, double side, const cli::Bounds& bounds) {
    return {corner, side, bounds.placement(corner, side)};
  }
  cli::Pixel operator()(Vec2 point) const { return world(point); }
  /// Returns the map from a person's own frame.
  cli::Placement person(const Stand& stand) const;
  /// Draws a scale at the lower left.
  void draw_scale(cli::Svg& svg) const;
  /// Shows what another panel shows in detail.
  void draw_frame(cli::Svg& svg, const cli::Bounds& bounds) const;
};

/// What classes of all figures look like.
extern const std::string figure_css;

/// Returns centimetres as text.
std::string centimetres(double metres);

}  // namespace bch::lab
