// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/format/cut_discs.hpp"

#include <gtest/gtest.h>

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
        const CutDiscs discs = cut_discs(set.view(), shape * set.level_count() + level);
        const Hierarchy& hierarchy = shapes[shape].hierarchy;
        const std::vector<std::uint32_t> expected = cut(hierarchy, depths[level]);
        ASSERT_EQ(discs.count, expected.size());
        for (std::uint32_t i = 0; i < discs.count; ++i)
          ASSERT_EQ((Disc{discs.x[i], discs.y[i], discs.radius[i]}), hierarchy.nodes[expected[i]].disc);
        ++(discs.count == 1 ? single : discs.count < block_width ? few : many);
      }
  }
  EXPECT_GT(single, 24u);
  EXPECT_GT(few, 20u);
  EXPECT_GT(many, 20u);
}

}  // namespace
}  // namespace bch
