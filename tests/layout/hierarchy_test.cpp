// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/welzl.hpp"
#include "layout/enclosing_disc/enclosing_disc.hpp"
#include "layout/enclosing_disc/enclosing_discs.hpp"
#include "layout/format/contours.hpp"
#include "layout/hierarchy/builder.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"
#include "tests/support/hierarchy_checks.hpp"
#include "tests/support/test.hpp"

namespace bch {
namespace {

using test::polygon;

TEST(ContourHierarchy, TheLargestThresholdLeavesOneDisc) {
  const Hierarchy hierarchy =
      contour_hierarchy(polygon({{0, 0}, {1, 0}, {0, 1}}), std::numeric_limits<float>::max());
  EXPECT_EQ(hierarchy.nodes.size(), 1u);
  test::expect_sound(hierarchy);
}

TEST(ContourHierarchy, CutsGrowDownToTheLeaves) {
  const Shape shape = test::synthetic_shapes(13, 8).back();
  const std::uint32_t deepest = detail::height(shape.hierarchy);
  EXPECT_EQ(cut(shape.hierarchy, 0), std::vector<std::uint32_t>{0});
  EXPECT_EQ(cut(shape.hierarchy, 1).size(), 2u);
  std::size_t before = 1;
  for (std::uint32_t depth = 1; depth <= deepest; ++depth) {
    const std::size_t size = cut(shape.hierarchy, depth).size();
    EXPECT_GT(size, before);
    before = size;
  }
  EXPECT_EQ(cut(shape.hierarchy, deepest), cut(shape.hierarchy, all_depths));
}

TEST(ContourHierarchy, RejectsBadInput) {
  const Outline good = polygon({{0, 0}, {1, 0}, {0, 1}});
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float threshold : {0.0f, -1.0f, nan, std::numeric_limits<float>::infinity()})
    EXPECT_THROW(contour_hierarchy(good, threshold), std::invalid_argument);
  EXPECT_EQ(test::complaint([&] { contour_hierarchy(good, -1e-9f); }),
            "hierarchy: expected a threshold above 0 m, found -1e-09");
  EXPECT_THROW(contour_hierarchy(good, 1e-8f), std::length_error);
  EXPECT_THROW(contour_hierarchy(Outline{}, 0.01f), std::invalid_argument);
  EXPECT_THROW(contour_hierarchy(polygon({{0, 0}, {nan, 0}, {0, 1}}), 0.01f), std::invalid_argument);
  EXPECT_THROW(contour_hierarchy(polygon({{0, 0}, {1e-8f, 0}, {0, 0}}), 0.01f), std::invalid_argument);
  EXPECT_THROW(contour_hierarchy(polygon({{0, 0}, {2e6f, 0}, {0, 1}}), 1e3f), std::invalid_argument);
  EXPECT_THROW(contour_hierarchy(good, 0.01f, static_cast<detail::SplitRule>(2)), std::invalid_argument);
}

/// Coordinates are multiples of it, so none is larger than the shape.
TEST(ContourHierarchy, RejectsAGridStepAboveTheReach) {
  Outline outline = polygon({{0, 0}, {1, 0}, {0, 1}});
  outline.grid_step = 1;
  EXPECT_NO_THROW(contour_hierarchy(outline, 0.01f));
  for (const float step : {1.0001f, 1e30f, -1.0f, std::numeric_limits<float>::quiet_NaN()}) {
    outline.grid_step = step;
    EXPECT_THROW(contour_hierarchy(outline, 0.01f), std::invalid_argument) << step;
    Hierarchy hierarchy;
    EXPECT_THROW(detail::HierarchyBuilder().root(outline.points, step, hierarchy), std::invalid_argument)
        << step;
  }
}

TEST(ProjectedHierarchy, HasOneLeafATriangle) {
  test::Random random(3);
  std::vector<Vec2> vertices(120);
  for (Vec2& p : vertices)
    p = {static_cast<float>(random.uniform(-0.5, 0.5)), static_cast<float>(random.uniform(-0.5, 0.5))};
  vertices[7] = vertices[8];
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (int i = 0; i < 300; ++i)
    triangles.push_back({random.below(120), random.below(120), random.below(120)});
  triangles.push_back(triangles[0]);
  triangles.push_back({5, 5, 5});
  const Hierarchy hierarchy = detail::projected_hierarchy(vertices, triangles);
  test::expect_sound(hierarchy);
  EXPECT_EQ(cut(hierarchy, all_depths).size(), triangles.size());
  std::vector<std::uint32_t> sources = hierarchy.source;
  std::sort(sources.begin(), sources.end());
  for (std::uint32_t i = 0; i < sources.size(); ++i) EXPECT_EQ(sources[i], i);
  for (std::size_t i = 0; i < hierarchy.primitives.size(); ++i)
    EXPECT_EQ(hierarchy.primitives[i].b, vertices[triangles[hierarchy.source[i]][1]]);

  EXPECT_THROW(detail::projected_hierarchy(vertices, {}), std::invalid_argument);
  triangles[3][1] = 120;
  EXPECT_THROW(detail::projected_hierarchy(vertices, triangles), std::invalid_argument);
  triangles[3][1] = 0;
  vertices[60].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(detail::projected_hierarchy(vertices, triangles), std::invalid_argument);
}

TEST(ProjectedHierarchy, CountsVerticesOfTrianglesAlone) {
  std::vector<Vec2> vertices = {{0.5f, 0}, {0, 1}, {-1, 0}};
  const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 2}};
  const Hierarchy expected = detail::projected_hierarchy(vertices, triangles);
  vertices.push_back({1e5f, 3e8f});
  vertices.push_back({std::numeric_limits<float>::infinity(), 0});
  const Hierarchy hierarchy = detail::projected_hierarchy(vertices, triangles);
  EXPECT_EQ(hierarchy.max_extent, expected.max_extent);
  EXPECT_EQ(hierarchy.nodes[0].disc, expected.nodes[0].disc);
}

TEST(Hierarchy, IsCheckedNodeByNode) {
  const Hierarchy good = contour_hierarchy(test::polygon({{-0.3f, 0}, {0.3f, 0}, {0, 0.4f}}), 0.01f);
  EXPECT_NO_THROW(validate(good));
  EXPECT_NO_THROW(validate(detail::fixed_cylinder(0.3f)));
  const auto expect_rejected = [&](const char* what, auto change) {
    Hierarchy bad = good;
    change(bad);
    EXPECT_TRUE(test::has(test::complaint([&] { validate(bad); }), what));
  };
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  expect_rejected("no nodes", [](Hierarchy& h) { h.nodes.clear(); });
  expect_rejected("extent", [](Hierarchy& h) { h.max_extent = 0; });
  expect_rejected("extent", [](Hierarchy& h) { h.max_extent = std::numeric_limits<double>::quiet_NaN(); });
  expect_rejected("node 3", [](Hierarchy& h) { h.nodes[3].disc.x = nan; });
  expect_rejected("node 0", [](Hierarchy& h) { h.nodes[0].disc.y = 2; });
  expect_rejected("node 5", [](Hierarchy& h) { h.nodes[5].disc.radius = 0; });
  expect_rejected("node 5", [](Hierarchy& h) { h.nodes[5].disc.radius = nan; });
  expect_rejected("node 1", [](Hierarchy& h) { h.nodes[1].second_child = 2; });
  expect_rejected("node 1",
                  [](Hierarchy& h) { h.nodes[1].second_child = static_cast<std::uint32_t>(h.nodes.size()); });
}

TEST(FixedCylinder, IsOneDiscAboutTheAgent) {
  const Hierarchy cylinder = detail::fixed_cylinder(0.4f);
  ASSERT_EQ(cylinder.nodes.size(), 1u);
  EXPECT_EQ(cylinder.nodes[0].disc.x, 0);
  EXPECT_GE(cylinder.nodes[0].disc.radius, 0.4f);
  EXPECT_NEAR(cylinder.nodes[0].disc.radius, 0.4f, 1e-6);
  for (const float radius : {0.0f, -0.1f, std::numeric_limits<float>::quiet_NaN(), 1e7f})
    EXPECT_THROW(detail::fixed_cylinder(radius), std::invalid_argument);
}

double distance(double x, double y, Vec2 p) {
  return std::hypot(x - static_cast<double>(p.x), y - static_cast<double>(p.y));
}

double radius_about(double x, double y, const std::vector<Vec2>& points) {
  double radius = 0;
  for (const Vec2& p : points) radius = std::max(radius, distance(x, y, p));
  return radius;
}

/// By trying every disc that two or three of the points define.
double smallest_radius(const std::vector<Vec2>& points) {
  double best = points.size() == 1 ? 0 : HUGE_VAL;
  const auto offer = [&](double x, double y) {
    if (std::isfinite(x) && std::isfinite(y)) best = std::min(best, radius_about(x, y, points));
  };
  for (const Vec2& a : points)
    for (const Vec2& b : points) {
      const double ax = a.x, ay = a.y, bx = b.x, by = b.y;
      offer((ax + bx) / 2, (ay + by) / 2);
      for (const Vec2& c : points) {
        const double cx = c.x, cy = c.y, d = 2 * (ax * (by - cy) + bx * (cy - ay) + cx * (ay - by));
        const double a2 = ax * ax + ay * ay, b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
        offer((a2 * (by - cy) + b2 * (cy - ay) + c2 * (ay - by)) / d,
              (a2 * (cx - bx) + b2 * (ax - cx) + c2 * (bx - ax)) / d);
      }
    }
  return best;
}

void expect_smallest(const std::vector<Vec2>& points) {
  const detail::EnclosingDisc disc = detail::smallest_enclosing_disc(points);
  EXPECT_DOUBLE_EQ(disc.radius, radius_about(disc.centre.x, disc.centre.y, points))
      << points.size() << " points";
  EXPECT_NEAR(disc.radius, smallest_radius(points), 2e-7 * detail::max_extent(points))
      << points.size() << " points";
}

TEST(EnclosingDisc, OfFewPointsAndOfSuchOnALineOrACircle) {
  const std::vector<std::vector<Vec2>> sets = {{{3, 4}},
                                               {{0, 0}, {2, 0}},
                                               {{0, 0}, {2, 0}, {1, 0.5f}},
                                               {{0, 0}, {2, 0}, {1, 2}},
                                               std::vector<Vec2>(5, {1, 2}),
                                               {{0, 0}, {1, 1}, {2, 2}, {3, 3}, {0.5f, 0.5f}},
                                               {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 0}},
                                               {{0, 0}, {1, 1e-7f}, {2, 0}, {1, -1e-7f}}};
  for (const std::vector<Vec2>& points : sets) expect_smallest(points);
  EXPECT_EQ(detail::smallest_enclosing_disc(sets[1]).radius, 1);
}

/// Sets of every size and kind: on a line, on a circle, few distinct points, anywhere, and hardly off a line.
struct PointSets {
  std::vector<Vec2> points;
  std::vector<detail::PointRange> ranges;

  std::vector<Vec2> set(std::size_t i) const {
    return {points.begin() + ranges[i].begin, points.begin() + ranges[i].end};
  }
};
PointSets random_sets(test::Random& random, double scale) {
  PointSets sets;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    const std::uint32_t begin = static_cast<std::uint32_t>(sets.points.size()),
                        size = 1 + random.below(i % 50 == 0 ? 300 : 12);
    for (std::uint32_t k = 0; k < size; ++k) {
      double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
      if (i % 4 == 0) y = 0.5 * x;
      if (i % 4 == 1) x = std::cos(4 * x), y = std::sqrt(1 - x * x);
      if (i % 4 == 2) x = std::round(2 * x), y = std::round(2 * y);
      if (i % 8 == 7) y *= 1e-4;
      sets.points.push_back({static_cast<float>(scale * x), static_cast<float>(scale * y)});
    }
    sets.ranges.push_back({begin, begin + size});
  }
  return sets;
}

TEST(EnclosingDiscs, HoldTheirPointsAndAreAsSmallAsWelzls) {
  test::Random random(3);
  bench::Welzl welzl;
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const PointSets sets = random_sets(random, scale);
    std::vector<detail::SolvedDisc> discs(sets.ranges.size());
    detail::EnclosingDiscs().solve(sets.points, sets.ranges, discs);
    for (std::size_t i = 0; i < discs.size(); ++i) {
      const std::vector<Vec2> points = sets.set(i);
      const double radius = std::sqrt(discs[i].square_radius);
      EXPECT_DOUBLE_EQ(radius, radius_about(discs[i].centre.x, discs[i].centre.y, points));
      const double smallest = std::sqrt(welzl(points).square_radius);
      ASSERT_LE(radius, (1 + 1e-6) * smallest + 0x1p-24 * detail::max_extent(points))
          << points.size() << " points";
      EXPECT_NEAR(radius, detail::smallest_enclosing_disc(points).radius,
                  0x1p-24 * detail::max_extent(points));
      if (points.size() <= 12) expect_smallest(points);
    }
  }
}

TEST(EnclosingDiscs, AreTheSameBitsOnEveryInstructionSet) {
  test::Random random(4);
  const PointSets sets = random_sets(random, 1);
  std::vector<detail::SolvedDisc> expected(sets.ranges.size());
  detail::EnclosingDiscs(detail::build_implementations().back()).solve(sets.points, sets.ranges, expected);
  for (const detail::BuildImplementation& implementation : detail::build_implementations()) {
    if (!implementation.supported()) continue;
    std::vector<detail::SolvedDisc> discs(sets.ranges.size());
    detail::EnclosingDiscs(implementation).solve(sets.points, sets.ranges, discs);
    for (std::size_t i = 0; i < discs.size(); ++i) {
      ASSERT_EQ(discs[i].centre, expected[i].centre) << implementation.name << ", set " << i;
      ASSERT_EQ(discs[i].square_radius, expected[i].square_radius) << implementation.name << ", set " << i;
    }
  }
}

}  // namespace
}  // namespace bch
