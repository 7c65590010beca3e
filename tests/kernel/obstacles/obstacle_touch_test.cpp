// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

// Which agents touch obstacles, and which are held by areas: cases that random scenes do not have.

#include "baselines/leaf_segments.hpp"
#include "baselines/quad.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"
#include "tests/support/obstacle_scenes.hpp"
#include "tests/support/plane_geometry.hpp"
#include "tests/support/test.hpp"

namespace bch {
namespace {

using Obstacles = test::ObstacleTest;
using test::Crowd;
using test::ObstacleScene;

using test::infinity;

using baselines::Quad;
using baselines::QuadVector;

int sign(Quad value) {
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}
Quad side(QuadVector a, QuadVector b, QuadVector p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}
/// Segments that are not collinear.
bool cross(QuadVector a, QuadVector b, QuadVector p, QuadVector q) {
  return sign(side(a, b, p)) * sign(side(a, b, q)) <= 0 && sign(side(p, q, a)) * sign(side(p, q, b)) <= 0;
}

/// Returns the distance of a point from a segment, whose differences are taken in 113 bits.
double distance_of(QuadVector p, QuadVector from, QuadVector to) {
  const auto plain = [](Quad value) { return static_cast<long double>(value); };
  return static_cast<double>(test::distance_to_segment<long double>(
      plain(p.x - from.x), plain(p.y - from.y), 0, 0, plain(to.x - from.x), plain(to.y - from.y)));
}

/// Calls `each` for the segments of an outline whose points are placed.
void for_each_segment(const std::vector<QuadVector>& points, const Outline& outline,
                      const std::function<void(QuadVector, QuadVector)>& each) {
  for (std::size_t contour = 0; contour < outline.contours(); ++contour) {
    const std::size_t begin = outline.contour_begin[contour], end = outline.contour_begin[contour + 1];
    for (std::size_t i = begin; i < end; ++i) each(points[i], points[i + 1 == end ? begin : i + 1]);
  }
}

/// Returns the distance of a placed outline from a wall that it does not meet.
double distance_of(const std::vector<QuadVector>& points, const Outline& outline, QuadVector a,
                   QuadVector b) {
  double least = infinity;
  for_each_segment(points, outline, [&](QuadVector p, QuadVector q) {
    least = std::min({least, distance_of(p, a, b), distance_of(a, p, q), distance_of(b, p, q)});
  });
  return least;
}

/// Returns whether a contour of a placed outline goes round a point that is not on it.
bool contains(const std::vector<QuadVector>& points, const Outline& outline, QuadVector at) {
  bool held = false;
  for (std::size_t contour = 0; contour < outline.contours(); ++contour) {
    bool odd = false;
    const std::size_t begin = outline.contour_begin[contour], end = outline.contour_begin[contour + 1];
    for (std::size_t i = begin, before = end - 1; i < end; before = i++) {
      const QuadVector p = points[before], q = points[i];
      if ((p.y > at.y) != (q.y > at.y)) odd ^= (side(p, q, at) > 0) == (q.y > p.y);
    }
    held = held || odd;
  }
  return held;
}

/// Returns whether a placed outline, as an area, meets a wall.
bool meets(const std::vector<QuadVector>& points, const Outline& outline, QuadVector a, QuadVector b) {
  bool met = contains(points, outline, a);
  for_each_segment(points, outline, [&](QuadVector p, QuadVector q) { met = met || cross(a, b, p, q); });
  return met;
}

std::vector<QuadVector> placed(const Outline& outline, double x, double y, double heading) {
  const QuadVector turn = baselines::quad_rotation(heading);
  std::vector<QuadVector> points;
  for (const Vec2& point : outline.points)
    points.push_back(QuadVector{Quad{x}, Quad{y}} +
                     turned(turn, {Quad{static_cast<double>(point.x)}, Quad{static_cast<double>(point.y)}}));
  return points;
}

/// A vertex of an outline next to a wall, within the last bits: where 113-bit arithmetic says that outline and wall meet, the answer
/// is a hit at every level; where they are farther apart than the price, exact leaves say that they do not. A clearance of outlines is never
/// larger than their distance, and below it by no more than the price.
TEST_F(Obstacles, NeverMissWhatTouches) {
  std::size_t touching = 0, apart = 0;
  for (std::uint32_t k = 0; k < test::samples(200'000); ++k) {
    const std::uint32_t number = random.below(static_cast<std::uint32_t>(shapes.size()));
    const Shape& shape = shapes[number];
    const double far = random.below(3) == 0 ? 1e8 : 0;
    Crowd crowd;
    const double px = far + random.uniform(-5, 5), py = random.uniform(-5, 5),
                 heading = random.uniform(-4, 4);
    for (std::uint8_t level = 0; level < 4; ++level) crowd.add({number, px, py, heading, level});
    const std::vector<QuadVector> points = placed(shape.outline, px, py, heading);
    // The wall stands on the side of the shape that a direction shows, or anywhere.
    const double angle = random.uniform(-4, 4), c = std::cos(angle), s = std::sin(angle);
    std::size_t vertex = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (points[i].x * c + points[i].y * s > points[vertex].x * c + points[vertex].y * s) vertex = i;
    if (random.below(4) == 0) vertex = random.below(static_cast<std::uint32_t>(points.size()));
    const double nudge =
        random.below(2) == 0 ? 0 : random.uniform(-1, 1) * std::exp2(-10.0 - random.below(40));
    const double at_x = static_cast<double>(points[vertex].x) + nudge * c,
                 at_y = static_cast<double>(points[vertex].y) + nudge * s;
    const double long_way = random.below(4) == 0 ? 1e7 : 3, before = random.uniform(0, long_way),
                 behind = random.below(4) == 0 ? 0 : random.uniform(0, long_way);
    const std::vector<double> x = {at_x - before * -s, at_x + behind * -s},
                              y = {at_y - before * c, at_y + behind * c};
    const std::vector<std::uint64_t> paths = {0, 2};
    std::vector<std::uint8_t> hits(4);
    collide(set, crowd.agents(), ObstacleSet({x, y, paths}), hits);
    std::vector<float> apart_by(4);
    clearance(set, crowd.agents(), ObstacleSet({x, y, paths}), {.distance = apart_by},
              {.leaves = Leaves::segments});
    const QuadVector a{Quad{x[0]}, Quad{y[0]}}, b{Quad{x[1]}, Quad{y[1]}};
    if (meets(points, shape.outline, a, b)) {
      ASSERT_EQ(hits, std::vector<std::uint8_t>(4, 1)) << k;
      ASSERT_EQ(apart_by, std::vector<float>(4, 0)) << k;
      ++touching;
    } else {
      const double far_end =
          std::abs(x[0] - px) + std::abs(x[1] - px) + std::abs(y[0] - py) + std::abs(y[1] - py);
      const double price = 1.01 * baselines::LeafSegments::margin_of(shape) + 1e-14 * far_end;
      const bool has_segments = shape.hierarchy.nodes.size() > 1;
      const double distance = distance_of(points, shape.outline, a, b), measured = double{apart_by.back()};
      ASSERT_TRUE(hits.back() == 0 || !has_segments || distance <= price) << k;
      ASSERT_LE(measured, distance) << k;
      ASSERT_TRUE(!has_segments || distance - measured <= price + 1.2e-7 * distance) << k;
      ASSERT_TRUE(hits.back() == 0 || measured == 0) << k;
      apart += hits.back() == 0;
    }
    for (std::size_t level = 1; level < 4; ++level) ASSERT_LE(hits[level], hits[level - 1]) << k;
  }
  EXPECT_GT(touching, test::samples(50'000));
  EXPECT_GT(apart, test::samples(5'000));
}

/// The distance of an outline from a wall anywhere, next to it and as far as a city, and as long as the limits allow, is that of the two, but
/// for the price.
TEST_F(Obstacles, AreAsFarAsOutlinesAre) {
  std::size_t apart = 0;
  double worst = 0;  // of the distances to the ends
  for (std::uint32_t k = 0; k < test::samples(20'000); ++k) {
    const std::uint32_t number = random.below(static_cast<std::uint32_t>(shapes.size()));
    const Shape& shape = shapes[number];
    const double heading = random.uniform(-4, 4), far = std::pow(10, random.uniform(-3, 5)),
                 at = random.uniform(-4, 4), length = std::pow(10, random.uniform(-3, 8.9)),
                 turn = random.uniform(-4, 4), before = random.below(2) * random.uniform(0, length);
    const double from_x = far * std::cos(at) - before * std::cos(turn),
                 from_y = far * std::sin(at) - before * std::sin(turn);
    const std::vector<double> x = {from_x, from_x + length * std::cos(turn)},
                              y = {from_y, from_y + length * std::sin(turn)};
    const std::vector<std::uint64_t> paths = {0, 2};
    Crowd crowd;
    crowd.add({number, 0, 0, heading, 3});
    std::vector<float> measured(1);
    clearance(set, crowd.agents(), ObstacleSet({x, y, paths}), {.distance = measured},
              {.leaves = Leaves::segments});
    const QuadVector a{Quad{x[0]}, Quad{y[0]}}, b{Quad{x[1]}, Quad{y[1]}};
    const std::vector<QuadVector> points = placed(shape.outline, 0, 0, heading);
    if (meets(points, shape.outline, a, b)) {
      ASSERT_EQ(measured[0], 0) << k;
      continue;
    }
    ++apart;
    const double distance = distance_of(points, shape.outline, a, b), below = distance - double{measured[0]};
    ASSERT_GE(below, 0) << k;
    if (shape.hierarchy.nodes.size() == 1) continue;
    const double margin = baselines::LeafSegments::margin_of(shape);
    const double to_ends = std::hypot(x[0], y[0]) + std::hypot(x[1], y[1]);
    ASSERT_LE(below, 1.01 * margin + 1.2e-7 * distance + 9e-15 * to_ends) << k;
    worst = std::max(worst, (below - 1.01 * margin - 1.2e-7 * distance) / to_ends);
  }
  EXPECT_GT(apart, test::samples(10'000));
  EXPECT_GT(worst, 2e-15);  // there are walls whose ends matter
}

/// Where a wall is as near to several segments of an outline, and several walls to one, the first ones count.
TEST_F(Obstacles, OfEquallyNearOnesTheFirstCounts) {
  const Shape square = test::contour_shape(test::polygon({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}));
  const ShapeSet squares({&square, 1});
  Crowd crowd;
  crowd.add({0, 0, 0, 0, 0});
  // Walls beside all four sides, each a metre away; the one above twice.
  const ObstacleSet walls = obstacles_from_wkt(
      "MULTILINESTRING((-3 2, 3 2), (-3 2, 3 2), (2 -3, 2 3), (-2 -3, -2 3), (-3 -2, 3 -2))");
  for (const Implementation& each : test::supported()) {
    float distance = 0;
    DiscPair discs{};
    NearestPoints points{};
    clearance(squares, crowd.agents(), walls,
              {.distance = {&distance, 1}, .discs = {&discs, 1}, .points = {&points, 1}},
              {.implementation = &each, .leaves = Leaves::segments});
    EXPECT_NEAR(distance, 1, 3e-6) << each.name;
    // The first side of the square leads along y = -1, and its end is as near to the third wall as all of it to the last one.
    EXPECT_EQ(discs.second, 2u) << each.name;
    EXPECT_EQ(points.first, (Vec2{1, -1})) << each.name;
    EXPECT_EQ(points.second, (Vec2{2, -1})) << each.name;
  }
}

/// Leaves of too many segments are measured as discs, beside others of the same set.
TEST_F(Obstacles, OfLeavesWithTooManySegments) {
  const std::vector<Shape> stars = {test::contour_shape(test::star(random, 20'000, 0.3, 0.31), 0.05f),
                                    test::contour_shape(test::star(random, 40, 0.2, 0.4))};
  const ShapeSet set_of_stars(stars);
  const baselines::ObstacleReference reference(stars, {}, Leaves::segments);
  ObstacleScene wall;
  wall.add({{-3, 0.5}, {3, 0.6}}, false);
  const Crowd crowd = test::crowd_about(random, set_of_stars, 20, 1);
  std::vector<float> distances(20);
  clearance(set_of_stars, crowd.agents(), wall.set(), {.distance = distances}, {.leaves = Leaves::segments});
  for (std::uint32_t i = 0; i < distances.size(); ++i) {
    const double gap = reference.outline_gap(crowd.agents(), i, wall.reference).gap;
    EXPECT_LE(double{distances[i]}, std::max(gap, 0.0)) << i;
    EXPECT_NEAR(double{distances[i]}, std::max(gap, 0.0), 1.2e-7) << i;
  }
}

/// The pole of a lamp within an outline is seen, but not in a set without outlines; a post in a ring's hole never.
TEST_F(Obstacles, InsideAnOutline) {
  const Shape square = test::contour_shape(test::polygon({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}));
  const ShapeSet squares({&square, 1}), discs({&square, 1}, {.outlines = false});
  Crowd crowd;
  crowd.add({0, 5, 5, 0.2, 0});
  for (const bool is_area : {false, true}) {
    ObstacleScene scene;
    scene.add({{5.1, 5}, {5.2, 5}, {5.1, 5.1}}, is_area);
    scene.add({{4.5, 4.6}}, false);
    const ObstacleSet obstacles = scene.set();
    std::vector<std::uint8_t> hits(1);
    const double near = 0.01;
    for (const ShapeSet* const set : {&squares, &discs}) {
      collide(*set, crowd.agents(), obstacles, hits);
      EXPECT_EQ(hits[0], set == &squares);
      within(*set, crowd.agents(), obstacles, {&near, 1}, hits);
      EXPECT_EQ(hits[0], set == &squares);
      std::vector<float> distance(1), time(1);
      clearance(*set, crowd.agents(), obstacles, {distance});
      EXPECT_EQ(distance[0] == 0, set == &squares);
      const std::vector<double> still(1);
      time_of_impact(*set, crowd.agents(), {still, still}, obstacles, time);
      EXPECT_EQ(time[0] == 0, set == &squares);
    }
    bch::Crowd collider;
    const Rows<std::uint32_t> rows = collider.obstacles(squares, crowd.agents(), obstacles);
    EXPECT_EQ(std::vector<std::uint32_t>(rows[0].begin(), rows[0].end()), (std::vector<std::uint32_t>{0, 1}));
  }
}

/// The rule of even and odd where a ray goes through vertices: each belongs to one side of it.
TEST_F(Obstacles, HoldWhatIsLevelWithTheirVertices) {
  const ShapeSet discs(std::vector<Shape>{{{}, detail::fixed_cylinder(0.125f)}});
  // A diamond; teeth whose tips are level with what stands before them; a notch.
  const ObstacleSet areas = obstacles_from_wkt(
      "POLYGON((1 0, 0 1, -1 0, 0 -1)) POLYGON((4 1, 5 0, 6 1, 7 0, 8 1, 8 2, 4 2))"
      "POLYGON((4 -3, 5 -3, 5 -2, 4 -2.5))");
  Crowd crowd;
  const double at_x[] = {0, -2, 2, -2, 2, 5, 6, -2, 3, 4.7, 9},
               at_y[] = {0, 0, 0, 1, 1, 1, 1.5, -3, -2.5, -2.5, 1};
  for (std::size_t i = 0; i < std::size(at_x); ++i) crowd.add({0, at_x[i], at_y[i], 0, 0});
  std::vector<std::uint8_t> hits(crowd.x.size());
  collide(discs, crowd.agents(), areas, hits);
  EXPECT_EQ(hits, (std::vector<std::uint8_t>{1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0}));
}

std::vector<Vec2> triangle(float x) {
  return {{x + 0.1f, 0}, {x - 0.05f, 0.0866f}, {x - 0.05f, -0.0866f}};
}

/// An area holds one of two contours: discs above it are inside, those below stick out of it, and the whole body is crossed.
TEST_F(Obstacles, HoldAPartOfAnOutline) {
  const std::vector<std::vector<Vec2>> pair = {triangle(-1), triangle(1)};
  const std::vector<Shape> both = {shape_from_polygons(pair), shape_from_polygons(pair, 3)};  // in one leaf
  const ShapeSet set_of_both(both, {.depths = {0, 1, 2, 3, 4, all_depths}});
  for (const double side : {-1.0, 1.0}) {
    ObstacleScene scene;
    std::vector<ObstacleScene::Point> ring;
    for (int k = 0; k < 32; ++k) {
      const double angle = 2 * std::numbers::pi * k / 32, radius = 0.105 / std::cos(std::numbers::pi / 32);
      ring.push_back({side + radius * std::cos(angle), radius * std::sin(angle)});
    }
    scene.add(ring, true);
    Crowd crowd;
    for (std::uint32_t shape = 0; shape < 2; ++shape)
      for (std::uint8_t level = 0; level < 6; ++level) crowd.add({shape, 0, 0, 0, level});
    std::vector<std::uint8_t> hits(crowd.x.size());
    for (const Leaves leaves : {Leaves::discs, Leaves::segments}) {
      collide(set_of_both, crowd.agents(), scene.set(), hits, {.leaves = leaves});
      EXPECT_EQ(hits, std::vector<std::uint8_t>(hits.size(), 1)) << side;
    }
  }
}

/// A leaf has outlines on both sides of a border that meets neither.
TEST_F(Obstacles, HoldAPartOfALeaf) {
  const std::vector<std::vector<Vec2>> four = {triangle(-1.15f), triangle(-0.85f), triangle(0.85f),
                                               triangle(1.15f)};
  const std::vector<Shape> shape = {shape_from_polygons(four, 0.5f)};
  const ShapeSet leaves(shape);
  ASSERT_TRUE(leaves.exact_leaves());
  ASSERT_EQ(leaves.discs(0, 0).size(), 2u);
  for (const double middle : {-1.15, -0.85, 0.85, 1.15}) {
    ObstacleScene scene;
    scene.add({{middle - 0.11, -0.1}, {middle + 0.11, -0.1}, {middle + 0.11, 0.1}, {middle - 0.11, 0.1}},
              true);
    Crowd crowd;
    crowd.add({0, 0, 0, 0, 0});
    std::uint8_t hit = 0;
    collide(leaves, crowd.agents(), scene.set(), {&hit, 1});
    EXPECT_EQ(hit, 1) << middle;
  }
}
}  // namespace
}  // namespace bch
