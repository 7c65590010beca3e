// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/interior.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "layout/supports.hpp"
#include "tests/outline_checks.hpp"
#include "tests/scenes.hpp"

namespace bch {
namespace {

TEST(Supports, AreExtentsOfTheDiscsEnlarged) {
  const std::vector<Disc> discs = {{1, 0, 0.5f}, {-0.25f, 0.5f, 0.125f}};
  const Supports heights = supports(discs, 1.5);
  for (std::uint32_t at = 0; at < support_stride; ++at) {
    // All even directions twice over, then all odd ones.
    const std::uint32_t direction = 2 * (at % (support_directions / 2)) + (at >= support_directions ? 1 : 0);
    const double angle = 2 * std::numbers::pi * direction / support_directions;
    double extent = -HUGE_VAL;
    for (const Disc& d : discs)
      extent =
          std::max(extent, std::cos(angle) * static_cast<double>(d.x) +
                               std::sin(angle) * static_cast<double>(d.y) + static_cast<double>(d.radius));
    EXPECT_GT(heights[at], extent);
    EXPECT_LT(heights[at], extent + 5e-5);
  }
}

TEST(Interior, DiscsAreInsideTheLargestContour) {
  const std::vector<Shape> shapes = test::synthetic_shapes(51, 64);
  int with_discs = 0;
  for (const Shape& shape : shapes) {
    const Interior inside = interior(shape.outline, shape.hierarchy.reach);
    int discs = 0;
    for (std::uint32_t k = 0; k < block_width; ++k) {
      if (std::isinf(inside.x[k])) continue;
      ++discs;
      EXPECT_GT(inside.radius[k], 0);
      for (int i = 0; i < 64; ++i) {
        const double angle = i * std::numbers::pi / 32, r = inside.radius[k];
        EXPECT_TRUE(test::inside(shape.outline, static_cast<double>(inside.x[k]) + r * std::cos(angle),
                                 static_cast<double>(inside.y[k]) + r * std::sin(angle)));
      }
    }
    with_discs += discs > 0;
  }
  EXPECT_GE(with_discs, 56);  // slender shapes may fall between the points of the raster
}

TEST(Interior, ExtremesAreTheFarthestPoints) {
  test::Random random(3);
  const Outline outline = test::star(random, 40, 0.2, 0.5);
  const Interior inside = interior(outline, 0.5);
  for (std::uint32_t k = 0; k < extreme_stride; ++k) {
    const double angle = 2 * std::numbers::pi * k / extreme_directions;
    const double c = std::cos(angle), s = std::sin(angle);
    double farthest = -HUGE_VAL;
    for (const Vec2& p : outline.points)
      farthest = std::max(farthest, c * static_cast<double>(p.x) + s * static_cast<double>(p.y));
    EXPECT_NEAR(c * static_cast<double>(inside.extreme_x[k]) + s * static_cast<double>(inside.extreme_y[k]),
                farthest, 1e-9);
  }
}

TEST(Interior, AWhiskerHasNone) {
  Outline line;
  line.points = {{0, 0}, {1, 0}};
  line.contour_begin.push_back(2);
  line.grid_step = 0x1p-22f;
  const Interior inside = interior(line, 1);
  for (std::uint32_t k = 0; k < block_width; ++k) EXPECT_TRUE(std::isinf(inside.x[k]));
}

}  // namespace
}  // namespace bch
