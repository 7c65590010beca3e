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

}  // namespace bch::test
