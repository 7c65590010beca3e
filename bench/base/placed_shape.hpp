// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <vector>

#include <bch/body_set.hpp>
#include <bch/shapes.hpp>

#include "bench/base/svg.hpp"

namespace bch::cli {

/// Holds a transformation from a shape's own frame to the picture.
struct Placement {
  Pixel origin;
  double cosine = 1;
  double sine = 0;
  double scale = 1;  ///< pixels per metre

  Pixel operator()(Vec2 point) const;
};

/// Represents the least rectangle of the ground that holds discs, metres.
struct Bounds {
  double left = 1e30, right = -1e30, low = 1e30, high = -1e30;

  void add(const Disc& disc);
  /// Returns the scale, and the placement, by which it fills most of a panel of the picture.
  double scale(double side) const;
  Placement placement(Pixel corner, double side) const;
};

/// Represents a disc of the picture, or a sphere seen from above.
struct PixelDisc {
  Pixel centre;
  double radius = 0;
  double height = 0;  ///< of the centre, in pixels as well
};

PixelDisc placed(const Placement& placement, const Disc& disc);
PixelDisc placed(const Placement& placement, const Sphere& sphere);

/// Returns the discs of a cut in the picture.
std::vector<PixelDisc> placed_cut(const Placement& placement, const Hierarchy& hierarchy,
                                  std::uint32_t depth);

bool overlap(const PixelDisc& a, const PixelDisc& b);
/// Returns the discs that no other one covers, as seen from above.
std::vector<PixelDisc> visible(const std::vector<PixelDisc>& discs);

/// Returns the largest of 1, 2, 5, 10 ... of any decade that is at most so long: what a scale shows, metres.
double round_length(double most);

void draw_outline(Svg& svg, const Placement& placement, const Outline& outline);
void draw_discs(Svg& svg, const std::vector<PixelDisc>& discs);

}  // namespace bch::cli
