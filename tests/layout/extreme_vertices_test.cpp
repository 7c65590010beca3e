// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline/extreme_vertices.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include <bch/outline_builder.hpp>

#include "layout/hierarchy/builder.hpp"
#include "tests/support/scenes.hpp"

namespace bch {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

struct Soup {
  std::vector<Vec2> positions;
  Triangles triangles;
};

/// Of kinds: anywhere, on a line, on a circle, on few points of a grid, flat and away from the origin, where others decide
/// the reach than the disc. The last vertex is far and in no triangle.
Soup random_soup(test::Random& random, int kind) {
  Soup soup;
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
    const Soup soup = random_soup(random, i % 5);
    detail::ExtremeVertices extremes(soup.triangles, soup.positions.size());
    extremes.find(soup.positions);
    OutlineBuilder outlines(soup.triangles, soup.positions.size());
    outlines.build(soup.positions, outline);
    EXPECT_EQ(extremes.grid_step(), outline.grid_step);
    builder.contour(outline, 0.01f, SplitRule::centroid, expected, 0);
    builder.root(extremes.points(), extremes.grid_step(), root);
    ASSERT_EQ(root.nodes.size(), 1u);
    EXPECT_EQ(root.reach, expected.reach);
    const Disc &disc = root.nodes[0].disc, &other = expected.nodes[0].disc;
    const double unit = 0x1p-23 * root.reach;
    EXPECT_NEAR(disc.radius, other.radius, unit);
    for (std::size_t v = 0; v + 1 < soup.positions.size(); ++v)
      ASSERT_LE(std::hypot(static_cast<double>(soup.positions[v].x) - static_cast<double>(disc.x),
                           static_cast<double>(soup.positions[v].y) - static_cast<double>(disc.y)),
                disc.radius);
  }
}

TEST(ExtremeVertices, AreFewOfManyVertices) {
  test::Random random(82);
  Soup soup;
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
