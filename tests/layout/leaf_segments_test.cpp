// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/format/leaf_segments.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include <bch/shape_set.hpp>

#include "layout/format/shape_arrays.hpp"
#include "tests/support/scenes.hpp"

namespace bch {
namespace {

TEST(LeafSegments, AreRunsOrLists) {
  const std::vector<std::vector<std::uint32_t>> leaves = {{7}, {1, 2, 3}, {4, 6}, {0x1000000}, {9, 8}, {5}};
  std::vector<std::uint32_t> long_run(127);
  for (std::uint32_t i = 0; i < 127; ++i) long_run[i] = 50 + i;
  std::vector<std::uint32_t> words;
  for (std::size_t i = 0; i < leaves.size(); ++i) detail::add_leaf(leaves[i], i, leaves.size() + 1, words);
  detail::add_leaf(long_run, leaves.size(), leaves.size() + 1, words);
  for (std::size_t i = 0; i < leaves.size(); ++i) EXPECT_EQ(detail::segments_of(words, i), leaves[i]);
  EXPECT_EQ(detail::segments_of(words, leaves.size()), long_run);
  EXPECT_EQ(detail::leaf_segments_size(words, leaves.size() + 1), words.size());
  EXPECT_EQ(words.size(), 7 + 3 + 2 + 3);
  long_run.push_back(177);
  detail::add_leaf(long_run, 1, leaves.size() + 1, words);
  EXPECT_TRUE(detail::segments_of(words, 1).empty());
}

TEST(Plans, WithoutOutlinesHaveNoExactLeaves) {
  const std::vector<Shape> shapes = test::synthetic_shapes(2405, 8);
  EXPECT_TRUE(ShapeSet(shapes).exact_leaves());
  EXPECT_FALSE(ShapeSet(shapes, {.outlines = false}).exact_leaves());
  EXPECT_FALSE(ShapeSet(shapes, {{0, 3, 6}}).exact_leaves());
  EXPECT_EQ(ShapeSet(shapes, {.outlines = false}).arrays().points.size(), 0u);
  std::vector<Shape> bare = shapes;
  for (Shape& shape : bare) shape.hierarchy.of_segments = false;
  EXPECT_FALSE(ShapeSet(bare).exact_leaves());
  EXPECT_TRUE(ShapeSet(bare).solid());
}

TEST(HierarchyPrimitives, HaveToBeThoseOfTheOutline) {
  const auto rejected = [](const auto& change) {
    std::vector<Shape> changed = test::synthetic_shapes(2408, 2);
    change(changed[1].hierarchy);
    try {
      ShapeSet{changed};
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(rejected([](Hierarchy& h) { h.primitive_ranges.pop_back(); }).find("shape 1: hierarchy:"),
            std::string::npos);
  EXPECT_NE(rejected([](Hierarchy& h) { h.primitive_ranges.back().end += 1; }).find("holds primitives"),
            std::string::npos);
  EXPECT_NE(rejected([](Hierarchy& h) {
              h.primitive_ranges.back().begin = h.primitive_ranges.back().end;
            }).find("holds primitives"),
            std::string::npos);
  EXPECT_NE(rejected([](Hierarchy& h) { h.source[0] = 100'000; }).find("comes from segment 100000"),
            std::string::npos);
}

}  // namespace
}  // namespace bch
