// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/hierarchy/builder.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"
#include "layout/outline/extreme_vertices.hpp"
#include "tests/support/test.hpp"

namespace bch {
namespace {

Outline with_another(Outline outline, std::vector<Vec2> contour) {
  test::append(outline, test::polygon(std::move(contour)));
  return outline;
}

const std::vector<Vec2> square = {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}};

void expect_refused(const Outline& outline, const std::string& message) {
  EXPECT_EQ(test::complaint([&] { validate(outline); }), message);
}

TEST(ValidateOutline, ClockwiseContoursAreRefused) {
  expect_refused(test::polygon({{0, 0}, {0, 1}, {1, 1}, {1, 0}}),
                 "outline: contour 0 is clockwise, its area -1 m^2");
  expect_refused(with_another(test::polygon(square), {{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}),
                 "outline: contour 1 is clockwise, its area -4 m^2");
  // Small ones, too, and far away.
  expect_refused(test::polygon({{1000, 0}, {1000, 0.25f}, {1000.25f, 0}}),
                 "outline: contour 0 is clockwise, its area -0.03125 m^2");
  EXPECT_THROW(contour_hierarchy(test::polygon({{0, 0}, {0, 1}, {1, 1}}), 0.01f), std::invalid_argument);
}

TEST(ValidateOutline, WhatIsNotFiniteIsNamed) {
  const float infinity = std::numeric_limits<float>::infinity();
  for (const float bad : {infinity, -infinity, std::numeric_limits<float>::quiet_NaN()})
    for (std::size_t i = 0; i < square.size(); ++i)
      for (const bool of_x : {false, true}) {
        Outline outline = test::polygon(square);
        (of_x ? outline.points[i].x : outline.points[i].y) = bad;
        expect_refused(outline, "outline: point " + std::to_string(i) + " is not finite");
      }
}

TEST(ValidateOutline, ContoursMayTouchCrossAndHoldEachOther) {
  const std::vector<Outline> allowed = {
      test::polygon({{1, 1}}),                                                // a point
      test::polygon({{0, 0}, {2, 1}}),                                        // a whisker
      test::polygon({{0, 0}, {0.1f, 0.7f}, {0, 0}, {0.3f, -0.1f}}),           // two
      test::polygon({{0, 0}, {1, 0}, {0.5f, 1}, {0, 2}, {1, 2}, {0.5f, 1}}),  // a pinch, half of it clockwise
      test::polygon({{0, 3}, {-2, -3}, {3, 1}, {-3, 1}, {2, -3}}),            // a star in one stroke
      test::polygon({{0.1f, 0.2f}, {1e-7f, -0.3f}, {0.123456f, -0.777777f}, {0.9f, 0.3f}}),  // on no grid
      with_another(test::polygon(square), {{-1, -1}, {1, -1}, {1, 1}}),  // one inside the other
      with_another(test::polygon(square), {{1, 1}, {3, 1}, {3, 3}}),     // across each other
      with_another(test::polygon(square), square),
  };
  for (std::size_t i = 0; i < allowed.size(); ++i) EXPECT_NO_THROW(validate(allowed[i])) << i;
}

const std::vector<Vec2> footprint = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

TEST(OutlineFromPolygons, TakesPolygonsEitherWayRoundAndClosedOrNot) {
  const std::vector<Vec2> clockwise(footprint.rbegin(), footprint.rend());
  std::vector<Vec2> closed = footprint;
  closed.insert(closed.begin() + 2, closed[1]);  // a corner twice
  closed.push_back(closed.front());
  for (const std::vector<Vec2>& polygon : {footprint, clockwise, closed}) {
    const Outline outline = outline_from_polygons(std::vector<std::vector<Vec2>>{polygon});
    EXPECT_EQ(outline.points, footprint);
    EXPECT_EQ(outline.contour_begin, (std::vector<std::uint32_t>{0, 4}));
    EXPECT_EQ(outline.grid_step, 0);
    EXPECT_EQ(area(outline), 1);
  }
}

TEST(OutlineFromPolygons, KeepsPolygonsThatOverlapAndCross) {
  const std::vector<Vec2> beside = {{0.5f, 0}, {2, 0}, {2, 1}}, bow = {{0, 0}, {3, 3}, {3, 0}, {0, 2}};
  const Outline outline = outline_from_polygons(std::vector<std::vector<Vec2>>{footprint, beside, bow});
  ASSERT_EQ(outline.contours(), 3u);
  EXPECT_EQ(outline.contour(1).size(), 3u);
  const Hierarchy hierarchy = contour_hierarchy(outline, 0.05f);
  EXPECT_GT(hierarchy.nodes.size(), 50u);
}

TEST(OutlineFromPolygons, RejectsWhatIsNone) {
  const auto expect = [](const std::string& message, const std::vector<std::vector<Vec2>>& polygons) {
    EXPECT_EQ(test::complaint([&] { outline_from_polygons(polygons); }), message);
  };
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  expect("outline: there are no polygons", {});
  expect("polygon 1: 2 different corners", {footprint, {{0, 0}, {1, 0}, {0, 0}}});
  expect("polygon 0: 0 different corners", {{}});
  expect("polygon 0: it has no area", {{{0, 0}, {1, 1}, {2, 2}}});
  expect("polygon 1: corner 2 is not finite", {footprint, {{0, 0}, {1, 0}, {nan, 1}}});
  expect("outline: expected an extent of 1e-6 to 1e6 m, found 1414213.5623730961",
         {{{0, 0}, {1e6f, 0}, {1e6f, 1e6f}}});
}

// ---- Vertices that decide the disc of a pose without its outline

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

struct FlatSoup {
  std::vector<Vec2> positions;
  Triangles triangles;
};

/// Of kinds: anywhere, on a line, on a circle, on few points of a grid, flat and away from the origin, where others decide
/// the extent than the disc. The last vertex is far and in no triangle.
FlatSoup random_flat_soup(test::Random& random, int kind) {
  FlatSoup soup;
  const std::uint32_t count = 3 + random.below(40);
  for (std::uint32_t i = 0; i < count; ++i) {
    double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
    if (kind == 1) y = 0.5 * x;
    if (kind == 2) y = std::sin(4 * x), x = std::cos(4 * x);
    if (kind == 3) x = std::round(2 * x), y = std::round(2 * y);
    if (kind == 4) y = 5 + 0.2 * y;
    soup.positions.push_back({static_cast<float>(x + 0.3), static_cast<float>(y)});
  }
  for (std::uint32_t i = 0; i + 2 < count; ++i) soup.triangles.push_back({i, i + 1, i + 2});
  soup.positions.push_back({9.0f, 9.0f});
  return soup;
}

/// What an outline makes of the same triangles; it may round crossings, and disagree about which of equal points decides.
TEST(ExtremeVertices, DecideTheDiscAroundTheOutline) {
  test::Random random(81);
  detail::HierarchyBuilder builder;
  Hierarchy root, expected;
  Outline outline;
  for (int i = 0; i < 2000; ++i) {
    const FlatSoup soup = random_flat_soup(random, i % 5);
    detail::ExtremeVertices extremes(soup.triangles, soup.positions.size());
    extremes.find(soup.positions);
    OutlineBuilder outlines(soup.triangles, soup.positions.size());
    outlines.build(soup.positions, outline);
    EXPECT_EQ(extremes.grid_step(), outline.grid_step);
    builder.contour(outline, 0.01f, detail::SplitRule::centroid, expected, 0);
    builder.root(extremes.points(), extremes.grid_step(), root);
    ASSERT_EQ(root.nodes.size(), 1u);
    EXPECT_EQ(root.max_extent, expected.max_extent);
    const Disc &disc = root.nodes[0].disc, &other = expected.nodes[0].disc;
    const double unit = 0x1p-23 * root.max_extent;
    EXPECT_NEAR(disc.radius, other.radius, unit);
    for (std::size_t v = 0; v + 1 < soup.positions.size(); ++v)
      ASSERT_LE(std::hypot(static_cast<double>(soup.positions[v].x) - static_cast<double>(disc.x),
                           static_cast<double>(soup.positions[v].y) - static_cast<double>(disc.y)),
                disc.radius);
  }
}

TEST(ExtremeVertices, AreFewOfManyVertices) {
  test::Random random(82);
  FlatSoup soup;
  for (std::uint32_t i = 0; i < 3000; ++i)
    soup.positions.push_back(
        {static_cast<float>(random.uniform(-1, 1)), static_cast<float>(random.uniform(-0.3, 0.3))});
  for (std::uint32_t i = 0; i + 2 < 3000; ++i) soup.triangles.push_back({i, i + 1, i + 2});
  detail::ExtremeVertices extremes(soup.triangles, soup.positions.size());
  extremes.find(soup.positions);
  EXPECT_LT(extremes.points().size(), 300u);
}

TEST(ExtremeVertices, RejectWhatHasNoReach) {
  const Triangles one = {{0, 1, 2}};
  std::vector<Vec2> positions(3);
  detail::ExtremeVertices extremes(one, 3);
  EXPECT_THROW(extremes.find(positions), std::invalid_argument);
  positions[1].x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(extremes.find(positions), std::invalid_argument);
  positions[1].x = 1;
  EXPECT_NO_THROW(extremes.find(positions));
}

}  // namespace
}  // namespace bch
