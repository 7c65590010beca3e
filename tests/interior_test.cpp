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

constexpr double step = 2 * std::numbers::pi / support_directions;

TEST(Supports, AreExtentsOfTheDiscsEnlarged) {
  const std::vector<Disc> discs = {{1, 0, 0.5f}, {-0.25f, 0.5f, 0.125f}};
  const Supports heights = supports(discs, 1.5);
  for (std::uint32_t k = 0; k < support_stride; ++k) {
    double extent = -HUGE_VAL;
    for (const Disc& d : discs)
      extent =
          std::max(extent, std::cos(k * step) * static_cast<double>(d.x) +
                               std::sin(k * step) * static_cast<double>(d.y) + static_cast<double>(d.radius));
    EXPECT_GT(heights[k], extent);
    EXPECT_LT(heights[k], extent + 3e-5);
    if (k >= support_directions) {
      EXPECT_EQ(heights[k], heights[k - support_directions]);
    }
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
    const double c = std::cos(k * step), s = std::sin(k * step);
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
