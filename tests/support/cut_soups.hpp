// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <gtest/gtest.h>

#include "layout/outline/mesh_outliner.hpp"
#include "tests/support/outline_checks.hpp"
#include "tests/support/outline_soups.hpp"

namespace bch::test {

/// Returns the part of a mesh that lies between two heights, clipped corner by corner in long double.
Soup part_between(Positions positions, Triangles triangles, const Heights& heights);
/// Returns a soup on a grid, without the triangles that are points there.
Soup rounded(Soup soup, float grid_step);

/// Finds the outline between two heights, and passes it to `expect` with the part of the mesh that lies there. Where there is none, that
/// part has to be points and what is near the origin.
template <class Expect>
void expect_right_cut(Positions positions, Triangles triangles, const Heights& heights, Expect expect) {
  SCOPED_TRACE("from " + std::to_string(heights.bottom) + " to " + std::to_string(heights.top) + " m");
  const Outline found = detail::MeshOutliner(triangles, positions, {.between = heights}).outline(positions);
  const Soup part = part_between(positions, triangles, heights);
  if (found.contours() > 0) {
    validate(found);
    return expect(found, rounded(part, found.grid_step));
  }
  float max_extent = 0;
  for (const auto& [x, y, z] : part.positions) max_extent = std::max({max_extent, std::abs(x), std::abs(y)});
  for (const auto& [a, b, c] : part.triangles)
    for (const std::uint32_t v : {b, c}) {
      const Vec3 &from = part.positions[a], &to = part.positions[v];
      EXPECT_LE(std::max(std::abs(to.x - from.x), std::abs(to.y - from.y)),
                std::max(0x1p-22f * max_extent, 2e-6f));
    }
}

}  // namespace bch::test
