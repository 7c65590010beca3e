// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "tests/support/outline_arrangement.hpp"
#include "tests/support/scenes.hpp"

namespace bch::test {

struct Soup {
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Draws one to a dozen triangles, sometimes thirty, with integer coordinates (times 2^-10 m) below 2 to 32,
/// where degenerate cases are frequent. They share vertices or not. Half the soups have a distant triangle
/// beside them that makes the integers steps of the grid.
Soup random_soup(Random& random);

/// Returns the triangles in steps of an outline's grid; coordinates must be on it.
std::vector<IntegerTriangle> on_grid(const Soup& soup, float grid_step);

std::vector<IntegerContour> on_grid(const Outline& outline);

// Triangles that share no vertices, so that each is a component of its own. Coordinates are multiples of 2^-10 m.

/// Returns triangles on a square lattice, none of which touches another.
Soup separate_triangles(std::uint32_t count);

/// Returns triangular frames (three quadrilaterals each) inside one another's holes, `depth` of them, and a
/// triangle in the innermost hole; `count` such nests side by side. The outline has a triangle for each nest.
Soup nested_frames(std::uint32_t count, std::uint32_t depth);

/// Returns a beam with `teeth` triangles below it. Between any two teeth there is a triangle that touches
/// neither, and on each tooth one that lies inside it. `before`: a triangle stands to the left of everything.
Soup comb(std::uint32_t teeth, bool before);

/// Returns a wheel of triangles about its centre, with small triangles inside. `before`: as of a comb.
Soup wheel(std::uint32_t triangles, bool before);

/// Returns triangles that touch the next in a corner: a chain.
Soup chain(std::uint32_t count);

/// Returns triangles whose corners differ from those of one triangle by less than `spread` times 2^-10 m.
Soup nearly_equal_triangles(Random& random, std::uint32_t count, std::uint32_t spread);

/// Adds the triangles of another soup, moved by so many times 2^-10 m.
void append(Soup& soup, const Soup& other, std::int32_t x, std::int32_t y);

/// Returns some of the soups above, small and at random places of a small field of a few hundred times 2^-10 m.
Soup jumble(Random& random);

}  // namespace bch::test
