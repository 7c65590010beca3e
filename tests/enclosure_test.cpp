// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/enclosure.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/scenes.hpp"

namespace bch {
namespace {

TEST(Enclosure, HoldsTheOutlineAndNoMore) {
  const Outline square = test::polygon({{1, 1}, {3, 1}, {3, 3}, {1, 3}});
  const Enclosure around = enclosure(square, 4.25);
  EXPECT_EQ(around.x, 2);
  EXPECT_EQ(around.y, 2);
  EXPECT_GT(around.outer_square, 2);
  EXPECT_LT(around.outer_square, 2.001);
  EXPECT_LT(around.inner_square, 2);
  EXPECT_GT(around.inner_square, 1.999);
}

TEST(Enclosure, SaysNothingOfSeveralContours) {
  Outline two;
  two.points = {{1, 1}, {2, 1}, {2, 2}, {-1, -1}, {-2, -1}, {-2, -2}};
  two.contour_begin = {0, 3, 6};
  EXPECT_EQ(enclosure(two, 3).inner_square, -std::numeric_limits<float>::infinity());
}

}  // namespace
}  // namespace bch
