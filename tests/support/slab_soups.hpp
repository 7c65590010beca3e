// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include <bch/outline.hpp>
#include <bch/outline_builder.hpp>

#include "tests/support/outline_checks.hpp"
#include "tests/support/outline_soups.hpp"

namespace bch::test {

/// Returns the part of a mesh that lies in a slab, clipped corner by corner in long double and rounded to a grid.
Soup slab_of(Positions positions, Triangles triangles, std::span<const float> planes, std::size_t slab,
             float grid_step);

/// Builds the outlines of all slabs, and passes each that is one to `expect` with the part of the mesh that lies in it.
template <class Expect>
void expect_right_slabs(OutlineBuilder& builder, Positions positions, Triangles triangles,
                        std::span<const float> planes, Expect expect) {
  std::vector<Outline> slabs(planes.size() + 1);
  builder.build(positions, planes, slabs);
  for (std::size_t i = 0; i < slabs.size(); ++i) {
    SCOPED_TRACE("slab " + std::to_string(i));
    const Soup soup = slab_of(positions, triangles, planes, i, slabs[i].grid_step);
    if (slabs[i].contours() == 0) {
      EXPECT_TRUE(soup.triangles.empty());
      continue;
    }
    validate(slabs[i]);
    const bool is_square = std::all_of(soup.positions.begin(), soup.positions.end(),
                                       [](const Vec3& p) { return std::hypot(p.x, p.y) < 1e-6f; });
    if (is_square)
      expect_covers(slabs[i], soup.positions, soup.triangles);
    else
      expect(slabs[i], soup);
  }
}

}  // namespace bch::test
