// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <vector>

#include <bch/shapes.hpp>

#include "baselines/exact_discs.hpp"
#include "layout/base/random.hpp"

namespace bch::bench {

/// Holds a shape with its exact discs and its geometry.
struct Specimen {
  Shape shape;
  baselines::ExactCut discs;  ///< of its leaves and all nodes above
  Outline geometry;           ///< what must be covered: its outline, or the triangles it was made from

  double reach() const { return shape.hierarchy.reach; }
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
/// reach.
std::vector<Specimen> usual_specimens(detail::Random& random, double reach);

enum class Soup { collinear, duplicate, folded, needle };
std::vector<Specimen> soup_specimens(detail::Random& random, Soup kind);

}  // namespace bch::bench
