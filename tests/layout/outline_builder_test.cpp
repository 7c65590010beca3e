// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/outline_builder.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include <bch/default_characters.hpp>

#include "layout/character/skinning.hpp"
#include "layout/outline/grid_geometry.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/support/outline_arrangement.hpp"
#include "tests/support/outline_checks.hpp"
#include "tests/support/outline_soups.hpp"

namespace bch {
namespace {

using test::Soup;

Outline build(const Soup& soup) {
  Outline outline;
  OutlineBuilder(soup.triangles, soup.positions.size()).build(soup.positions, outline);
  return outline;
}

/// Triangles of their own vertices, in metres, 2^22 steps each in the outline's grid.
Soup soup(const std::vector<std::array<std::array<float, 2>, 3>>& triangles) {
  Soup result;
  for (const auto& t : triangles) {
    const auto first = static_cast<std::uint32_t>(result.positions.size());
    for (const auto& [x, y] : t) result.positions.push_back({x, y, 0});
    result.triangles.push_back({first, first + 1, first + 2});
  }
  return result;
}

/// Contours in the unit of the input, for input whose outline has its corners there.
std::vector<std::vector<Vec2>> contours(const Outline& outline) {
  std::vector<std::vector<Vec2>> result;
  for (std::size_t c = 0; c < outline.contours(); ++c)
    result.emplace_back(outline.contour(c).begin(), outline.contour(c).end());
  return result;
}

using Contours = std::vector<std::vector<Vec2>>;

TEST(OutlineBuilder, ATriangleGoesRoundFromItsLeftmostCorner) {
  const Contours expected = {{{0, 0}, {3, 1}, {1, 2}}};
  EXPECT_EQ(contours(build(soup({{{{0, 0}, {3, 1}, {1, 2}}}}))), expected);
  EXPECT_EQ(contours(build(soup({{{{1, 2}, {3, 1}, {0, 0}}}}))), expected);
}

TEST(OutlineBuilder, AWhiskerIsWalkedThereAndBack) {
  EXPECT_EQ(contours(build(soup({{{{0, 0}, {2, 1}, {1, 0.5f}}}}))), (Contours{{{0, 0}, {2, 1}}}));
  EXPECT_EQ(contours(build(soup({{{{0, 0}, {2, 0}, {2, 2}}}, {{{1, 0.5f}, {3, 0.5f}, {3, 0.5f}}}}))),
            (Contours{{{0, 0}, {2, 0}, {2, 0.5f}, {3, 0.5f}, {2, 0.5f}, {2, 2}}}));
}

TEST(OutlineBuilder, APinchIsPassedOnceForEachPart) {
  EXPECT_EQ(contours(build(soup({{{{0, 0}, {1, 1}, {0, 2}}}, {{{1, 1}, {2, 0}, {2, 2}}}}))),
            (Contours{{{0, 0}, {1, 1}, {2, 0}, {2, 2}, {1, 1}, {0, 2}}}));
}

TEST(OutlineBuilder, APocketClosedByContactIsFilled) {
  // Four triangles around the square from (1, 1) to (2, 2), which meet in single points only.
  const Outline outline = build(soup({{{{0, 1}, {1.5f, 0}, {1, 1}}},
                                      {{{1.5f, 0}, {3, 1}, {2, 1}}},
                                      {{{3, 1}, {1.5f, 3}, {2, 2}}},
                                      {{{1.5f, 3}, {0, 1}, {1, 2}}}}));
  EXPECT_EQ(contours(outline), (Contours{{{0, 1}, {1.5f, 0}, {3, 1}, {1.5f, 3}}}));
}

TEST(OutlineBuilder, APointIsLeftOut) {
  const Outline outline = build(soup({{{{0, 0}, {1, 0}, {0, 1}}}, {{{2, 2}, {2, 2}, {2, 2}}}}));
  EXPECT_EQ(contours(outline), (Contours{{{0, 0}, {1, 0}, {0, 1}}}));
}

TEST(OutlineBuilder, CrossingsAreRoundedToTheNearestGridPoint) {
  // With a reach just above 1 m a step is 2^-22 m. The diagonals cross at (1/3, 1/3) m.
  const Soup crossed = soup({{{{0, 0}, {1, 1}, {1, 1}}}, {{{0, 0.5f}, {1, 0}, {1, 0}}}});
  const Outline outline = build(crossed);
  const float third = static_cast<float>(1398101) * 0x1p-22f;
  ASSERT_EQ(outline.grid_step, 0x1p-22f);
  EXPECT_EQ(contours(outline), (Contours{{{0, 0},
                                          {third, third},
                                          {1, 0},
                                          {third, third},
                                          {1, 1},
                                          {third, third},
                                          {0, 0.5f},
                                          {third, third}}}));
}

TEST(OutlineBuilder, PartsInsidePartsAreLeftOutAlsoWhereTheyTouch) {
  const Outline outline = build(soup({{{{0, 0}, {8, 0}, {0, 8}}},
                                      {{{1, 1}, {2, 1}, {1, 2}}},      // inside
                                      {{{0, 3}, {1, 3}, {1, 4}}},      // touches from inside
                                      {{{9, 9}, {9.5f, 9}, {9, 10}}},  // apart
                                      {{{9.125f, 9.125f}, {9.25f, 9.125f}, {9.125f, 9.25f}}}}));
  EXPECT_EQ(contours(outline), (Contours{{{0, 0}, {8, 0}, {0, 8}}, {{9, 9}, {9.5f, 9}, {9, 10}}}));
}

TEST(OutlineBuilder, VerticesThatAPosePartsAreNotTakenForOne) {
  // Two halves of a square with vertices of their own along the diagonal.
  Soup halves = soup({{{{0, 0}, {2, 0}, {2, 2}}}, {{{0, 0}, {2, 2}, {0, 2}}}});
  const std::vector<Vec3> bind_pose = halves.positions;
  OutlineBuilder builder(halves.triangles, halves.positions.size(), bind_pose);
  Outline outline;
  builder.build(halves.positions, outline);
  EXPECT_EQ(contours(outline), (Contours{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}}));
  for (std::size_t v = 3; v < 6; ++v) halves.positions[v].x -= 3;
  builder.build(halves.positions, outline);
  EXPECT_EQ(contours(outline), (Contours{{{-3, 0}, {-1, 2}, {-3, 2}}, {{0, 0}, {2, 0}, {2, 2}}}));
}

TEST(OutlineBuilder, RejectsBadInput) {
  const Soup good = soup({{{{0, 0}, {1, 0}, {0, 1}}}});
  Outline outline;
  EXPECT_THROW(OutlineBuilder({}, 3), std::invalid_argument);
  EXPECT_THROW(OutlineBuilder(good.triangles, 2), std::invalid_argument);
  const std::vector<Vec3> two(2);
  EXPECT_THROW(OutlineBuilder(good.triangles, 3, two), std::invalid_argument);
  std::vector<Vec3> bad = good.positions;
  bad[1].z = std::numeric_limits<float>::infinity();
  EXPECT_THROW(OutlineBuilder(good.triangles, 3, bad), std::invalid_argument);
  OutlineBuilder builder(good.triangles, 3);
  EXPECT_THROW(builder.build(two, outline), std::invalid_argument);
}

TEST(OutlineBuilder, RejectsWhatIsNotFiniteWhereverItIs) {
  const Soup good =
      soup({{{{0, 0}, {1, 0}, {0, 1}}}, {{{2, 0}, {3, 0}, {2, 1}}}, {{{4, 0}, {5, 0}, {4, 1}}}});
  OutlineBuilder builder(good.triangles, good.positions.size());
  Outline outline;
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  for (std::size_t v = 0; v < good.positions.size(); ++v)
    for (const int axis : {0, 1})
      for (const float bad : {nan, -nan, inf, -inf}) {
        std::vector<Vec3> positions = good.positions;
        (axis == 0 ? positions[v].x : positions[v].y) = bad;
        EXPECT_THROW(builder.build(positions, outline), std::invalid_argument)
            << v << ' ' << axis << ' ' << bad;
      }
}

TEST(Fraction, IsComparedExactly) {
  constexpr std::int64_t large = std::int64_t{1} << 49;
  const detail::Fraction smaller(large - 3, large - 2), larger(large - 2, large - 1);
  ASSERT_EQ(smaller.value, larger.value);
  EXPECT_EQ(detail::compare(smaller, larger), -1);
  EXPECT_EQ(detail::compare(larger, smaller), 1);
  EXPECT_EQ(detail::compare(detail::Fraction(1, 3), detail::Fraction(large / 3, large / 3 * 3)), 0);
  EXPECT_EQ(detail::compare(detail::Fraction(0, 1), larger), -1);
}

TEST(OutlineBuilder, AllocatesNothingTheSecondTime) {
  const Character man = default_male();
  detail::Skinner skinner(man);
  OutlineBuilder builder(man.triangles, man.vertices.size(), man.vertices);
  Outline outline;
  for (const bool second : {false, true})
    for (const PoseTime& time : sample_poses(man, 10)) {
      const auto positions = skinner.pose(time);
      const std::size_t before = test::allocation_count();
      builder.build(positions, outline);
      if (second) {
        EXPECT_EQ(test::allocation_count(), before);
      }
    }
  EXPECT_GT(test::allocation_count(), 0u);
}

/// The same union, made of the same triangles in another order, turned over, numbered otherwise, some twice.
/// Soups on the grid; and slivers of a few steps, whose contours the rounding of crossings may turn round.
TEST(OutlineBuilder, MakesOutlinesThatAreValid) {
  test::Random random(72);
  const std::uint32_t count = test::samples(20'000);
  for (std::uint32_t i = 0; i < count; ++i) {
    Soup soup = test::random_soup(random);
    if (i % 2 == 0)
      for (Vec3& p : soup.positions) {
        const auto size = static_cast<float>(std::exp2(random.uniform(-30, -10)));
        p.x += size * static_cast<float>(random.uniform(-1, 1));
        p.y += size * static_cast<float>(random.uniform(-1, 1));
      }
    Outline outline;
    try {
      outline = build(soup);
    } catch (const std::invalid_argument&) {
      continue;  // a soup of points
    }
    ASSERT_NO_THROW(validate(outline)) << i;
  }
}

TEST(OutlineBuilder, DependsOnTheUnionAlone) {
  test::Random random(5);
  for (int i = 0; i < 500; ++i) {
    Soup any = test::random_soup(random);
    Outline outline;
    try {
      outline = build(any);
    } catch (const std::invalid_argument&) {
      continue;
    }
    ASSERT_EQ(union_outline(any.positions, any.triangles).points, outline.points) << i;
    Soup other;
    for (std::size_t left = any.triangles.size(); left > 0;) {
      const std::size_t t = random.below(static_cast<std::uint32_t>(left));
      auto triangle = any.triangles[t];
      if (random.below(4) != 0) any.triangles[t] = any.triangles[--left];
      if (random.below(2) == 0) std::swap(triangle[1], triangle[2]);
      const auto first = static_cast<std::uint32_t>(other.positions.size());
      for (const std::uint32_t v : triangle) other.positions.push_back(any.positions[v]);
      other.triangles.push_back({first + 1, first + 2, first});
    }
    const Outline again = build(other);
    ASSERT_EQ(again.points, outline.points) << i;
    ASSERT_EQ(again.contour_begin, outline.contour_begin) << i;
  }
}

/// Points of a lattice four times as fine as the soups', those on an edge left aside: what a triangle covers
/// is inside.
TEST(OutlineBuilder, HoldsEveryCoveredLatticePoint) {
  test::Random random(77);
  std::size_t covered_points = 0;
  for (int i = 0; i < 1000; ++i) {
    const Soup any = test::random_soup(random);
    Outline outline;
    try {
      outline = build(any);
    } catch (const std::invalid_argument&) {
      continue;
    }
    constexpr float unit = 0x1p-10f;
    const auto triangles = test::on_grid(any, unit / 4);
    for (std::int64_t y = -1; y < 33; ++y)
      for (std::int64_t x = -1; x < 33; ++x) {
        const auto side = [&](test::IntegerPoint a, test::IntegerPoint b) {
          return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
        };
        bool covered = false, on_line = false;
        for (const auto& [a, b, c] : triangles) {
          const std::int64_t s = side(a, b), t = side(b, c), u = side(c, a);
          on_line |= s == 0 || t == 0 || u == 0;
          covered |= (s > 0 && t > 0 && u > 0) || (s < 0 && t < 0 && u < 0);
        }
        if (!covered || on_line) continue;
        ++covered_points;
        // Where the lattice is that of the grid, rounded crossings may have passed a point by.
        if (outline.grid_step < unit / 16) {
          ASSERT_TRUE(test::inside(outline, static_cast<double>(x) * 0.25 * static_cast<double>(unit),
                                   static_cast<double>(y) * 0.25 * static_cast<double>(unit)))
              << i << ": " << x << ", " << y;
        }
      }
  }
  EXPECT_GT(covered_points, 10000u);
}

}  // namespace
}  // namespace bch
