// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/format/cut_discs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/support/complaint.hpp"
#include "tests/support/scenes.hpp"

namespace bch {
namespace {

/// Levels of one disc, of fewer than a window and of many, in sets with and without nodes.
TEST(CutDiscs, AreThoseOfTheCutInItsOrder) {
  const std::vector<Shape> shapes = test::synthetic_shapes(71, 24);
  std::size_t single = 0, few = 0, many = 0;
  for (const std::vector<std::uint32_t>& depths :
       {std::vector<std::uint32_t>{0}, {0, 1, 2, 4, 9, all_depths}}) {
    const ShapeSet set(shapes, {depths, false});
    for (std::uint32_t shape = 0; shape < shapes.size(); ++shape)
      for (std::uint32_t level = 0; level < depths.size(); ++level) {
        const detail::CutDiscs discs = detail::cut_discs(set.view(), shape * set.level_count() + level);
        const Hierarchy& hierarchy = shapes[shape].hierarchy;
        const std::vector<std::uint32_t> expected = cut(hierarchy, depths[level]);
        ASSERT_EQ(discs.count, expected.size());
        for (std::uint32_t i = 0; i < discs.count; ++i)
          ASSERT_EQ((Disc{discs.x[i], discs.y[i], discs.radius[i]}), hierarchy.nodes[expected[i]].disc);
        const std::vector<Disc> copied = set.discs(shape, level);
        ASSERT_EQ(copied.size(), discs.count);
        for (std::uint32_t i = 0; i < discs.count; ++i) {
          ASSERT_EQ(copied[i], hierarchy.nodes[expected[i]].disc);
          const double x = copied[i].x, y = copied[i].y, radius = copied[i].radius;
          ASSERT_LE(std::sqrt(x * x + y * y) + radius, static_cast<double>(set.bounding_radius(shape)));
        }
        ++(discs.count == 1 ? single : discs.count < detail::block_width ? few : many);
      }
  }
  EXPECT_GT(single, 24u);
  EXPECT_GT(few, 20u);
  EXPECT_GT(many, 20u);
}

TEST(ShapeSetDiscs, RejectIndicesOutOfRange) {
  const ShapeSet set(test::synthetic_shapes(72, 3));
  EXPECT_EQ(test::complaint<std::out_of_range>([&] { set.discs(3, 0); }), "shape set: shape 3 of 3");
  EXPECT_EQ(test::complaint<std::out_of_range>([&] { set.discs(0, 1); }), "shape set: level 1 of 1");
  EXPECT_EQ(test::complaint<std::out_of_range>([&] { set.bounding_radius(3); }), "shape set: shape 3 of 3");
}

/// A single disc reaches as far as it is large, about wherever it is.
TEST(ShapeSetDiscs, ReachHoldsTheShape) {
  const float radius = ShapeSet(std::vector<Shape>{{{}, fixed_cylinder(0.5f)}}).bounding_radius(0);
  EXPECT_GE(radius, 0.5f);
  EXPECT_LT(radius, 0.50001f);
}

}  // namespace
}  // namespace bch
