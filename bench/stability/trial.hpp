// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <bch/shapes.hpp>

#include "baselines/exact_discs.hpp"
#include "bench/stability/stability.hpp"
#include "layout/base/random.hpp"

namespace bch::bench {

/// Holds a shape with its exact discs and its geometry.
struct Specimen {
  Shape shape;
  baselines::ExactCut discs;  ///< of its leaves and all nodes above
  Outline geometry;           ///< what must be covered: its outline, or the triangles it was made from

  double max_extent() const { return shape.hierarchy.max_extent; }
};

/// The functions below make specimens.
/// Errors of all: as contour_hierarchy() and outline() throw.

/// Makes a specimen from a contour of one's own, as it is.
Specimen raw_specimen(std::vector<Vec2> points, double threshold);
/// Makes a specimen from a contour that is put on the grid of outlines of that size.
Specimen contour_specimen(std::vector<Vec2> points, double threshold);

/// Makes a specimen from triangles, in order: three points each.
Specimen triangle_specimen(const std::vector<Vec2>& corners, double threshold);

/// Returns corners around (x, y) at distances within [inner, outer], y divided by `slenderness`.
std::vector<Vec2> ring(detail::Random& random, std::uint32_t corners, double inner, double outer,
                       double x = 0, double y = 0, double slenderness = 1);

/// Makes prisms a metre or two high, which begin above the ground.
std::vector<Specimen> prism_specimens(detail::Random& random);

/// Returns outlines of few and many corners about their origin and beside it, and strokes, each of this
/// extent.
std::vector<Specimen> usual_specimens(detail::Random& random, double max_extent);

enum class Soup { collinear, duplicate, folded, needle };
std::vector<Specimen> soup_specimens(detail::Random& random, Soup kind);

struct PlacedSpecimen {
  const Specimen* specimen;
  double x, y, heading;
  double z = 0;
};

/// Represents two agents with the exact answers about them, and the answers of simple tests.
class Trial {
 public:
  Trial(const PlacedSpecimen& a, const PlacedSpecimen& b);

  PlacedSpecimen a, b;

  /// Moves b along the direction (x, y), a unit vector, to where the two collide last by their discs. From there it moves b along the line of the centres of the two discs that separate the agents
  /// there, which may be discs above the cuts, by the gap for the sum of their radii. Correct to the rounding
  /// of b's position.
  void store_discs_in_contact(double x, double y, const std::function<double(double radii)>& gap);
  /// Moves b along the direction to where the outlines touch last, and by `gap` further.
  void store_outlines_in_contact(double x, double y, double gap);
  /// Moves b up to where it stands on a's top, and by `gap` further. Both have heights.
  void put_on_top(double gap);

  /// Returns how far the two are from colliding by their tight discs, metres. For a choice of one disc of
  /// each cut, take the largest gap between the first one or a disc above it and the second one or a disc
  /// above it; the result is the least value over all such choices; or how far their heights are
  /// apart, if that is more. Its sign is exact.
  double gap() const;
  bool outlines_meet() const;

  bool plain_float_hit() const;
  bool plain_double_hit() const;

  double max_extents() const { return a.specimen->max_extent() + b.specimen->max_extent(); }

 private:
  baselines::ExactCut cut_a_, cut_b_;  ///< in the world's axes about their agents
};

enum class Placing {
  contact,     ///< half of the pairs with discs, half with outlines near contact
  coincident,  ///< one shape twice, at one place or some bits beside it
  stacked,     ///< one above the other
  apart,       ///< as far as the setup says
};

/// Selects how the pairs of a row are made.
struct StabilitySetup {
  std::string value;
  double conditioning = 0;
  bool outside = false;    ///< of the documented domain
  std::uint32_t cost = 1;  ///< only one in so many pairs is tried, at least 20
  std::function<std::vector<Specimen>(detail::Random&)> make = [](detail::Random& random) {
    return usual_specimens(random, 1);
  };
  /// Makes the shapes of the second agent; null: as of the first.
  std::function<std::vector<Specimen>(detail::Random&)> make_other = nullptr;
  ShapeSetPlan plan = {};
  Placing placing = Placing::contact;
  double x = 0, y = 0, z = 0;       ///< of the first agent
  double apart_x = 0, apart_y = 0;  ///< the second agent's position from there, where they are apart
  std::function<double(detail::Random&)> heading = nullptr;  ///< null: all directions
  /// Draws a gap from the sum of two radii and the sum of the extents; null: gaps of all sizes.
  std::function<double(detail::Random&, double radii, double max_extents)> gap = nullptr;
};

/// Returns the distance from a value to the next float or double.
double float_step(double value);
double double_step(double value);

StabilityRow run_setup(const char* family, const StabilitySetup& setup, std::uint32_t pairs,
                       std::uint64_t seed);

}  // namespace bch::bench
