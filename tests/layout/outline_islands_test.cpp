// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/base/build_implementation.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/support/island_soups.hpp"
#include "tests/support/outline_arrangement.hpp"
#include "tests/support/test.hpp"

// Outlines of many disjoint islands. The large ones would take minutes if each island were compared with all others,
// beyond this test's time limit.

namespace bch {
namespace {

using test::Soup;

Outline build(const Soup& soup) {
  Outline outline;
  OutlineBuilder(soup.triangles, soup.positions.size(), soup.positions).build(soup.positions, outline);
  return outline;
}

void expect_equals_arrangement(const Soup& soup) {
  const Outline outline = build(soup);
  ASSERT_EQ(test::on_grid(outline), test::arrangement_outline(test::on_grid(soup, outline.grid_step)));
}

TEST(OutlineIslands, SmallSoupsHaveTheOutlinesOfTheirArrangements) {
  test::Random random(7);
  for (const Soup& soup : {test::separate_triangles(30), test::nested_frames(3, 3), test::comb(6, false),
                           test::comb(6, true), test::chain(20), test::nearly_equal_triangles(random, 12, 4),
                           test::nearly_equal_triangles(random, 12, 40)})
    expect_equals_arrangement(soup);
}

TEST(OutlineIslands, JumblesHaveTheOutlinesOfTheirArrangements) {
  test::Random random(8);
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE("jumble " + std::to_string(i));
    expect_equals_arrangement(test::jumble(random));
    if (HasFatalFailure()) return;
  }
}

/// Many jumbles apart from each other, with more candidates than are looked at without a tree: the outline is that of each.
TEST(OutlineIslands, AFieldOfJumblesHasTheOutlinesOfAllOfThem) {
  constexpr std::int32_t row = 36, pitch = 512;
  test::Random random(9);
  Soup field;
  std::vector<Soup> jumbles;
  for (std::int32_t i = 0; i < row * row; ++i) {
    jumbles.push_back(test::jumble(random));
    test::append(field, jumbles.back(), pitch * (i % row), pitch * (i / row));
  }
  ASSERT_GT(field.triangles.size(), 16'384u);
  const Outline outline = build(field);
  const auto step = static_cast<std::int64_t>(0x1p-10f / outline.grid_step);  // of a jumble's unit
  ASSERT_GT(step, 0);
  std::vector<std::vector<test::IntegerContour>> found(jumbles.size());
  for (test::IntegerContour& contour : test::on_grid(outline)) {
    const auto cell = [&](std::int64_t steps) { return (steps + 64 * step) / (pitch * step); };
    const std::int64_t x = cell(contour[0].x), y = cell(contour[0].y);
    for (test::IntegerPoint& p : contour) p.x -= x * pitch * step, p.y -= y * pitch * step;
    found[static_cast<std::size_t>(y * row + x)].push_back(contour);
  }
  for (std::size_t i = 0; i < jumbles.size(); ++i)
    ASSERT_EQ(found[i], test::arrangement_outline(test::on_grid(jumbles[i], outline.grid_step))) << i;
}

/// A contour of hundreds of stretches, of which each island asks a few.
TEST(OutlineIslands, AnIslandInAPocketIsApartAndOneOnAToothIsNot) {
  for (const bool before : {false, true}) expect_equals_arrangement(test::comb(24, before));
}

TEST(OutlineIslands, AnIslandInsideALongContourIsLeftOut) {
  for (const bool before : {false, true})
    EXPECT_EQ(build(test::wheel(1000, before)).contours(), before ? 2u : 1u);
}

TEST(OutlineIslands, CountsManySeparateTriangles) {
  constexpr std::uint32_t count = test::samples(360'000);
  const Outline outline = build(test::separate_triangles(count));
  ASSERT_EQ(outline.contours(), count);
  EXPECT_EQ(outline.points.size(), 3 * count);
  for (std::size_t c = 1; c < count; ++c) {
    const Vec2 before = outline.contour(c - 1)[0], now = outline.contour(c)[0];
    ASSERT_TRUE(before.x < now.x || (before.x == now.x && before.y < now.y)) << c;
  }
}

TEST(OutlineIslands, CountsManyNests) {
  const Outline outline = build(test::nested_frames(2000, 25));
  EXPECT_EQ(outline.contours(), 2000u);
  EXPECT_EQ(outline.points.size(), 6000u);
}

TEST(OutlineIslands, CountsIslandsBetweenManyTeeth) {
  constexpr std::uint32_t teeth = test::samples(50'000);
  for (const bool before : {false, true})
    EXPECT_EQ(build(test::comb(teeth, before)).contours(), teeth + 1 + (before ? 1 : 0));
}

TEST(OutlineIslands, CountsOneContourOfAChain) {
  EXPECT_EQ(build(test::chain(100'000)).contours(), 1u);
}

/// On each instruction set that it is compiled for, a builder finds the same.
TEST(OutlineIslands, EqualsItselfOnEveryInstructionSet) {
  const Soup soup = test::separate_triangles(20'000);
  const Outline expected = build(soup);
  for (const detail::BuildImplementation& row : detail::build_implementations()) {
    if (!row.supported()) continue;
    Outline outline;
    OutlineBuilder(soup.triangles, soup.positions.size(), soup.positions, row).build(soup.positions, outline);
    EXPECT_EQ(outline.points, expected.points) << row.name;
    EXPECT_EQ(outline.contour_begin, expected.contour_begin) << row.name;
  }
}

TEST(OutlineIslands, AllocateNothingTheSecondTime) {
  const Soup soup = test::comb(6000, true);
  OutlineBuilder builder(soup.triangles, soup.positions.size(), soup.positions);
  Outline outline;
  builder.build(soup.positions, outline);
  const std::size_t before = test::allocation_count();
  builder.build(soup.positions, outline);
  EXPECT_EQ(test::allocation_count(), before);
}

}  // namespace
}  // namespace bch
