// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <ostream>
#include <utility>
#include <vector>

#include <bch/collide.hpp>
#include <bch/obstacles.hpp>

#include "baselines/obstacle_reference.hpp"
#include "baselines/quad.hpp"
#include "baselines/slab_bodies.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/obstacle_scenes.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/slab_scenes.hpp"

namespace bch {
namespace {

using baselines::ObstacleReference;
using test::Crowd;
using test::ObstacleScene;
using test::Random;

constexpr double infinity = std::numeric_limits<double>::infinity();
const ShapeSetPlan four_levels{.depths = {0, 3, 6, all_depths}};

/// What all queries say of a scene.
struct Answers {
  std::vector<std::uint8_t> hits, near;
  std::vector<float> distance, deepest, time;
  std::vector<Vec2> direction;
  std::vector<DiscPair> discs, deepest_discs;
  std::vector<NearestPoints> points;
  std::vector<Penetration> ways;
  friend bool operator==(const Answers&, const Answers&) = default;
};

Answers all_answers(const ShapeSet& set, const Agents& agents, const ObstacleSet& obstacles,
                    const QueryOptions& options, std::span<const double> distances,
                    const Displacements& displacements) {
  const std::size_t n = agents.size();
  Answers all{std::vector<std::uint8_t>(n), std::vector<std::uint8_t>(n), std::vector<float>(n),
              std::vector<float>(n),        std::vector<float>(n),        std::vector<Vec2>(n),
              std::vector<DiscPair>(n),     std::vector<DiscPair>(n),     std::vector<NearestPoints>(n),
              std::vector<Penetration>(n)};
  collide(set, agents, obstacles, all.hits, options);
  within(set, agents, obstacles, distances, all.near, options);
  QueryOptions how = options;
  clearance(set, agents, obstacles, {all.distance, all.direction, all.discs, all.points}, how);
  how.overlap = Overlap::deepest;
  clearance(set, agents, obstacles, {.distance = all.deepest, .discs = all.deepest_discs}, how);
  penetration(set, agents, obstacles, all.ways, options);
  time_of_impact(set, agents, displacements, obstacles, all.time, options);
  return all;
}

float rounded_down(double value) {
  const float nearest = static_cast<float>(value);
  return static_cast<double>(nearest) > value ? std::nextafter(nearest, -HUGE_VALF) : nearest;
}

class Obstacles : public testing::Test {
 protected:
  Random random{2801};
  std::vector<Shape> shapes = test::synthetic_shapes(2802, 40);
  ShapeSet set{shapes, four_levels};

  std::vector<double> distances_for(std::size_t count) {
    std::vector<double> distances;
    for (std::size_t i = 0; i < count; ++i)
      distances.push_back(random.below(8) == 0 ? 0 : random.uniform(0, 1));
    return distances;
  }
};

/// Returns a vector of an agent's frame in the axes of the world.
Vec2 turned(const Agents& agents, std::uint32_t agent, double x, double y) {
  const double c = std::cos(agents.heading[agent]), s = std::sin(agents.heading[agent]);
  return {static_cast<float>(c * x - s * y), static_cast<float>(s * x + c * y)};
}

/// The direction and points of a distance are those of the disc and the segment that it names.
void expect_nearest(const ShapeSet& set, const Agents& agents, std::uint32_t agent,
                    const ObstacleScene& scene, float distance, const DiscPair& named, Vec2 direction,
                    const NearestPoints& points) {
  const std::uint32_t level = agents.level[agent];
  const Disc disc = set.discs(agents.shape[agent], level)[named.first];
  std::uint32_t number = named.second;
  std::size_t obstacle = 0;
  while (number >= scene.reference[obstacle].segments.size())
    number -= static_cast<std::uint32_t>(scene.reference[obstacle++].segments.size());
  const auto [ax, ay, bx, by] = scene.reference[obstacle].segments[number];
  const Vec2 centre = turned(agents, agent, disc.x, disc.y);
  const double cx = agents.x[agent] + double{centre.x} - ax, cy = agents.y[agent] + double{centre.y} - ay;
  const double ux = bx - ax, uy = by - ay, square = ux * ux + uy * uy;
  const double share = square > 0 ? std::clamp((cx * ux + cy * uy) / square, 0.0, 1.0) : 0.0;
  const double to_x = share * ux - cx, to_y = share * uy - cy;
  constexpr double near = 1e-5;
  EXPECT_NEAR(double{points.second.x}, double{centre.x} + to_x, near);
  EXPECT_NEAR(double{points.second.y}, double{centre.y} + to_y, near);
  const double length = std::hypot(to_x, to_y);
  EXPECT_NEAR(length - double{disc.radius}, double{distance}, near);
  EXPECT_NEAR(double{direction.x} * length, to_x, near);
  EXPECT_NEAR(double{direction.y} * length, to_y, near);
  EXPECT_NEAR(double{points.first.x}, double{centre.x} + double{disc.radius} * double{direction.x}, near);
  EXPECT_NEAR(double{points.first.y}, double{centre.y} + double{disc.radius} * double{direction.y}, near);
}

/// Every answer about every agent of many scenes is that of brute force over all discs and segments, on every instruction set.
void expect_brute_force(Random& random, std::span<const Shape> shapes, const ShapeSetPlan& plan,
                        std::uint32_t scenes) {
  const ShapeSet set(shapes, plan);
  const ObstacleReference with_segments(shapes, plan, Leaves::segments),
      with_discs(shapes, plan, Leaves::discs);
  std::size_t hits = 0, held = 0, apart = 0;
  for (std::uint32_t k = 0; k < scenes; ++k) {
    const ObstacleScene scene = test::obstacle_scene(random, 24, 3);
    const ObstacleSet obstacles = scene.set();
    const Crowd crowd = test::crowd_about(random, set, 1000, 3);
    const Agents agents = crowd.agents();
    std::vector<double> distances, dx, dy;
    for (std::size_t i = 0; i < agents.size(); ++i) {
      distances.push_back(random.below(8) == 0 ? 0 : random.uniform(0, 1));
      dx.push_back(random.uniform(-1, 1)), dy.push_back(random.uniform(-1, 1));
    }
    const Leaves leaves = k % 2 == 0 ? Leaves::segments : Leaves::discs;
    const ObstacleReference& reference = k % 2 == 0 ? with_segments : with_discs;
    const Answers best = all_answers(set, agents, obstacles, {.leaves = leaves}, distances, {dx, dy});
    for (const Implementation& each : implementations())
      if (k % 4 < 2 && each.supported()) {
        EXPECT_EQ(all_answers(set, agents, obstacles, {.implementation = &each, .leaves = leaves}, distances,
                              {dx, dy}),
                  best)
            << each.name;
      }
    for (std::uint32_t i = 0; i < agents.size(); ++i) {
      bool hit = false, is_held = false;
      for (const auto& obstacle : scene.reference) {
        hit = hit || reference.collides(agents, i, obstacle);
        is_held = is_held || reference.holds_a_centre(agents, i, obstacle);
      }
      const auto gap = reference.gap(agents, i, scene.reference);
      ASSERT_EQ(best.hits[i], hit) << "scene " << k << ", agent " << i;
      ASSERT_EQ(best.near[i], is_held || gap.gap <= distances[i]) << "scene " << k << ", agent " << i;
      ASSERT_EQ(best.deepest[i], rounded_down(gap.gap)) << "scene " << k << ", agent " << i;
      ASSERT_EQ(best.deepest_discs[i], (DiscPair{gap.disc, gap.segment}));
      const bool zero = is_held || gap.gap <= 0;
      ASSERT_EQ(best.distance[i], zero ? 0 : rounded_down(gap.gap)) << "scene " << k << ", agent " << i;
      ASSERT_EQ(best.discs[i], zero ? no_discs : (DiscPair{gap.disc, gap.segment}));
      if (zero) {
        ASSERT_EQ(best.direction[i], Vec2{});
        ASSERT_EQ(best.points[i], NearestPoints{});
      } else if (i % 8 == 0) {
        expect_nearest(set, agents, i, scene, best.distance[i], best.discs[i], best.direction[i],
                       best.points[i]);
      }
      hits += hit, held += is_held, apart += !zero;
    }
  }
  const std::size_t all = std::size_t{scenes} * 1000;
  EXPECT_GT(hits, all / 7);
  EXPECT_GT(held, all / 20);
  EXPECT_GT(apart, all / 7);
}

TEST_F(Obstacles, AreAsBruteForceSays) {
  expect_brute_force(random, shapes, four_levels, test::samples(160));
}

TEST_F(Obstacles, OfSingleDiscsAreAsBruteForceSays) {
  expect_brute_force(random, shapes, {.depths = {0}}, test::samples(24));
  const Disc five[] = {{0, -0.2f, 0.1f}, {0, -0.1f, 0.12f}, {0, 0, 0.13f}, {0, 0.1f, 0.12f}, {0, 0.2f, 0.1f}};
  std::vector<Shape> own = {shape_from_discs(five)};
  own.push_back({});
  own.back().hierarchy = fixed_cylinder(0.25f);
  expect_brute_force(random, own, {.depths = {0, all_depths}}, test::samples(24));
}

/// Scenes and agents moved far away by distances that are exact have the same answers, of any number of threads.
TEST_F(Obstacles, AnswerFarAwayAsAtTheOrigin) {
  const auto exact = [](double value) { return std::round(value * 0x1p20) * 0x1p-20; };
  ObstacleScene scene = test::obstacle_scene(random, 40, 3);
  Crowd crowd = test::crowd_about(random, set, 3000, 3);
  for (auto* values : {&scene.x, &scene.y, &crowd.x, &crowd.y})
    for (double& value : *values) value = exact(value);
  const std::vector<double> distances = distances_for(crowd.x.size());
  std::vector<double> way(crowd.x.size());
  for (double& length : way) length = random.uniform(-1, 1);
  const Answers here = all_answers(set, crowd.agents(), scene.set(), {}, distances, {way, way});
  for (const double far : {0x1p20, 0x1p27, 0x1.8p29}) {
    for (auto* values : {&scene.x, &crowd.x})
      for (double& value : *values) value += far;
    for (auto* values : {&scene.y, &crowd.y})
      for (double& value : *values) value -= far;
    const oneapi::tbb::global_control threads(oneapi::tbb::global_control::max_allowed_parallelism, 4);
    oneapi::tbb::task_arena(4).execute([&] {
      EXPECT_EQ(all_answers(set, crowd.agents(), scene.set(), {}, distances, {way, way}), here) << far;
    });
    for (auto* values : {&scene.x, &crowd.x})
      for (double& value : *values) value -= far;
    for (auto* values : {&scene.y, &crowd.y})
      for (double& value : *values) value += far;
  }
}

/// A wall of 2e8 m is where it is next to an agent, and so is one whose near end is far away.
TEST_F(Obstacles, MayBeLong) {
  const std::vector<Shape> disc = {{{}, fixed_cylinder(0.25f)}};
  const ShapeSet discs(disc);
  const double far = 1e8;
  for (const double gap : {-1e-6, 3e-6}) {
    Crowd crowd;
    crowd.add({0, 3, 0.25 + gap, 0.3, 0});
    crowd.add({0, far - 1, 0.25 + gap, 0.3, 0});
    crowd.add({0, -far - 0.25 - gap, 0, 0.3, 0});
    const std::vector<double> x = {-far, far}, y = {0, 0};
    const std::vector<std::uint64_t> paths = {0, 2};
    std::vector<std::uint8_t> hits(3);
    collide(discs, crowd.agents(), ObstacleSet({x, y, paths}), hits);
    EXPECT_EQ(hits, std::vector<std::uint8_t>(3, gap < 0)) << gap;
  }
}

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

/// Returns the distance of a point from a segment.
double distance_of(QuadVector p, QuadVector from, QuadVector to) {
  const auto plain = [](Quad value) { return static_cast<long double>(value); };
  const long double x = plain(to.x - from.x), y = plain(to.y - from.y), px = plain(p.x - from.x),
                    py = plain(p.y - from.y);
  const long double square = x * x + y * y, along = px * x + py * y;
  const long double share = square > 0 ? std::clamp(along / square, 0.0L, 1.0L) : 0.0L;
  return static_cast<double>(std::hypot(px - share * x, py - share * y));
}

/// Returns the distance of a placed outline from a wall that it does not meet.
double distance_of(const std::vector<QuadVector>& points, const Outline& outline, QuadVector a,
                   QuadVector b) {
  double least = infinity;
  for (std::size_t contour = 0; contour < outline.contours(); ++contour) {
    const std::size_t begin = outline.contour_begin[contour], end = outline.contour_begin[contour + 1];
    for (std::size_t i = begin; i < end; ++i) {
      const QuadVector p = points[i], q = points[i + 1 == end ? begin : i + 1];
      least = std::min({least, distance_of(p, a, b), distance_of(a, p, q), distance_of(b, p, q)});
    }
  }
  return least;
}

/// A vertex of an outline next to a wall, within the last bits: where 113-bit arithmetic says that outline and wall meet, the answer
/// is a hit at every level; where they are farther apart than the price, exact leaves say that they do not.
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
    const QuadVector turn = baselines::quad_rotation(heading);
    std::vector<QuadVector> points;
    for (const Vec2& point : shape.outline.points)
      points.push_back(QuadVector{Quad{px}, Quad{py}} + turned(turn, {Quad{static_cast<double>(point.x)},
                                                                      Quad{static_cast<double>(point.y)}}));
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
    bool meet = false;
    const QuadVector a{Quad{x[0]}, Quad{y[0]}}, b{Quad{x[1]}, Quad{y[1]}};
    for (std::size_t contour = 0; contour < shape.outline.contours(); ++contour) {
      const std::size_t begin = shape.outline.contour_begin[contour],
                        end = shape.outline.contour_begin[contour + 1];
      for (std::size_t i = begin; i < end && !meet; ++i) {
        meet = cross(a, b, points[i], points[i + 1 == end ? begin : i + 1]);
      }
    }
    if (meet) {
      ASSERT_EQ(hits, std::vector<std::uint8_t>(4, 1)) << k;
      ++touching;
    } else {
      const double far_end =
          std::abs(x[0] - px) + std::abs(x[1] - px) + std::abs(y[0] - py) + std::abs(y[1] - py);
      const double price = 1.01 * baselines::LeafSegments::margin_of(shape) + 1e-14 * far_end;
      ASSERT_TRUE(hits.back() == 0 || shape.hierarchy.nodes.size() == 1 ||
                  distance_of(points, shape.outline, a, b) <= price)
          << k;
      apart += hits.back() == 0;
    }
    for (std::size_t level = 1; level < 4; ++level) ASSERT_LE(hits[level], hits[level - 1]) << k;
  }
  EXPECT_GT(touching, test::samples(50'000));
  EXPECT_GT(apart, test::samples(5'000));
}

/// The pole of a lamp within an outline is seen in solid semantics alone; a post in a ring's hole never.
TEST_F(Obstacles, InsideAnOutline) {
  const Shape square = test::contour_shape(test::polygon({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}));
  const ShapeSet squares({&square, 1});
  Crowd crowd;
  crowd.add({0, 5, 5, 0.2, 0});
  const std::vector<double> x = {5.1, 5.2, 5.1, 4.5}, y = {5, 5, 5.1, 4.6};
  const std::vector<std::uint64_t> paths = {0, 3, 4};
  for (const bool is_area : {false, true}) {
    const std::vector<std::uint8_t> areas = {is_area, 0};
    const ObstacleSet obstacles({x, y, paths, {}, areas});
    std::vector<std::uint8_t> hits(1);
    collide(squares, crowd.agents(), obstacles, hits);
    EXPECT_EQ(hits[0], 0);
    collide(squares, crowd.agents(), obstacles, hits, {.semantics = Semantics::solid});
    EXPECT_EQ(hits[0], 1);
    const double near = 0.01;
    within(squares, crowd.agents(), obstacles, {&near, 1}, hits);
    EXPECT_EQ(hits[0], 0);
    within(squares, crowd.agents(), obstacles, {&near, 1}, hits, {.semantics = Semantics::solid});
    EXPECT_EQ(hits[0], 1);
    CrowdCollider collider;
    const auto rows =
        collider.collide_all(squares, crowd.agents(), obstacles, {.semantics = Semantics::solid});
    EXPECT_EQ(std::vector<std::uint32_t>(rows.obstacles[0].begin(), rows.obstacles[0].end()),
              (std::vector<std::uint32_t>{0, 1}));
  }
}

/// The rule of even and odd where a ray goes through vertices: each belongs to one side of it.
TEST_F(Obstacles, HoldWhatIsLevelWithTheirVertices) {
  const std::vector<Shape> disc = {{{}, fixed_cylinder(0.125f)}};
  const ShapeSet discs(disc);
  // A diamond; teeth whose tips are level with what stands before them; a notch.
  const std::vector<double> x = {1, 0, -1, 0, 4, 5, 6, 7, 8, 8, 4, 4, 5, 5, 4},
                            y = {0, 1, 0, -1, 1, 0, 1, 0, 1, 2, 2, -3, -3, -2, -2.5};
  const std::vector<std::uint64_t> paths = {0, 4, 11, 15};
  const std::vector<std::uint8_t> areas = {1, 1, 1};
  Crowd crowd;
  for (const auto& [at_x, at_y] : {std::pair{0.0, 0.0},
                                   {-2.0, 0.0},
                                   {2.0, 0.0},
                                   {-2.0, 1.0},
                                   {2.0, 1.0},
                                   {5.0, 1.0},
                                   {6.0, 1.5},
                                   {-2.0, -3.0},
                                   {3.0, -2.5},
                                   {4.7, -2.5},
                                   {9.0, 1.0}})
    crowd.add({0, at_x, at_y, 0, 0});
  std::vector<std::uint8_t> hits(crowd.x.size());
  collide(discs, crowd.agents(), ObstacleSet({x, y, paths, {}, areas}), hits);
  EXPECT_EQ(hits, (std::vector<std::uint8_t>{1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0}));
}

std::vector<Vec2> triangle(float x) {
  return {{x + 0.1f, 0}, {x - 0.05f, 0.0866f}, {x - 0.05f, -0.0866f}};
}

/// An area holds one of two contours: discs above it are inside, those below stick out of it, and the whole body is crossed.
TEST_F(Obstacles, HoldAPartOfAnOutline) {
  const std::vector<std::vector<Vec2>> pair = {triangle(-1), triangle(1)};
  std::vector<Shape> both = {shape_from_polygons(pair)};
  // One leaf holds both.
  both.push_back(shape_from_polygons(pair, 3));
  const ShapeSet set_of_both(both, {.depths = {0, 1, 2, 3, 4, all_depths}});
  for (const double side : {-1.0, 1.0}) {
    ObstacleScene scene;
    std::vector<ObstacleScene::Point> ring;
    for (int k = 0; k < 32; ++k) {
      const double angle = 2 * std::numbers::pi * k / 32, radius = 0.105 / std::cos(std::numbers::pi / 32);
      ring.push_back({side + radius * std::cos(angle), radius * std::sin(angle)});
    }
    scene.add_path(ring, true);
    scene.end_obstacle(true);
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
    scene.add_path({{middle - 0.11, -0.1}, {middle + 0.11, -0.1}, {middle + 0.11, 0.1}, {middle - 0.11, 0.1}},
                   true);
    scene.end_obstacle(true);
    Crowd crowd;
    crowd.add({0, 0, 0, 0, 0});
    std::uint8_t hit = 0;
    collide(leaves, crowd.agents(), scene.set(), {&hit, 1});
    EXPECT_EQ(hit, 1) << middle;
  }
}

/// Repeated points are no sides, and a post is left the way that a disc is beside it.
TEST_F(Obstacles, AreLeftAcrossRealSides) {
  const std::vector<Shape> disc = {{{}, fixed_cylinder(0.3f)}};
  const ShapeSet discs(disc);
  const std::vector<double> x = {0, 1, 1, 0, 0, 5, 5, 5}, y = {0, 0, 1, 1, 1, 0, 0, 2};
  const std::vector<std::uint64_t> paths = {0, 5, 8};
  const std::vector<std::uint8_t> areas = {1, 0};
  Crowd crowd;
  crowd.add({0, -0.1, 0.75, 0.5, 0}), crowd.add({0, 5.2, 0.1, 0.5, 0});
  std::vector<Penetration> ways(2);
  penetration(discs, crowd.agents(), ObstacleSet({x, y, paths, {}, areas}), ways);
  EXPECT_NEAR(ways[0].depth, 0.2, 1e-5);
  EXPECT_EQ(ways[0].x, -1);
  EXPECT_NEAR(ways[1].depth, 0.1, 1e-5);
  EXPECT_EQ(ways[1].x, 1);
  const std::vector<double> post_x = {0}, post_y = {0};
  const std::vector<std::uint64_t> post = {0, 1};
  for (std::size_t k = 0; k < 2; ++k) crowd.x[k] = 0.144 * (k == 0 ? 1 : -1), crowd.y[k] = 0.192;
  penetration(discs, crowd.agents(), ObstacleSet({post_x, post_y, post}), ways);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(ways[k].depth, 0.06, 1e-5);
    EXPECT_NEAR(ways[k].x, k == 0 ? 0.6 : -0.6, 1e-6);
    EXPECT_NEAR(ways[k].y, 0.8, 1e-6);
  }
}

/// A body in slabs collides where one of its parts does, as a shape of its own.
TEST_F(Obstacles, OfBodiesInSlabs) {
  const ShapeSetPlan plan = test::levels_of(test::three_slabs);
  const std::vector<Shape> bodies = test::bodies(random, plan);
  const ShapeSet whole(bodies, plan);
  std::vector<Shape> parts;
  std::vector<std::vector<std::uint32_t>> parts_of;
  for (const Shape& body : bodies) {
    auto& numbers = parts_of.emplace_back();
    const auto add = [&](const Shape& part) {
      if (part.hierarchy.nodes.empty()) return;
      numbers.push_back(static_cast<std::uint32_t>(parts.size()));
      parts.push_back({part.outline, part.hierarchy});
    };
    if (body.slabs.empty()) add(body);
    for (const Shape& slab : body.slabs) add(slab);
  }
  const ShapeSet apart(parts, {.depths = plan.depths});
  const QueryOptions solid{.semantics = Semantics::solid};
  std::size_t hits = 0;
  for (std::uint32_t k = 0; k < test::samples(16); ++k) {
    const ObstacleScene scene = test::obstacle_scene(random, 16, 3);
    const ObstacleSet obstacles = scene.set();
    const Crowd crowd = test::crowd_about(random, whole, 500, 3);
    const std::vector<double> distances = distances_for(500);
    std::vector<double> way(500);
    for (double& length : way) length = random.uniform(-1, 1);
    const Answers of_whole = all_answers(whole, crowd.agents(), obstacles, solid, distances, {way, way});
    for (std::uint32_t i = 0; i < 500; ++i) {
      Crowd pieces;
      for (const std::uint32_t part : parts_of[crowd.shape[i]])
        pieces.add({part, crowd.x[i], crowd.y[i], crowd.heading[i], crowd.level[i]});
      const std::vector<double> ways(pieces.x.size(), way[i]);
      const Answers of_parts =
          all_answers(apart, pieces.agents(), obstacles, solid, {&distances[i], 1}, {ways, ways});
      const auto any = [](const auto& values) { return *std::max_element(values.begin(), values.end()); };
      const auto least = [](const auto& values) { return *std::min_element(values.begin(), values.end()); };
      ASSERT_EQ(of_whole.hits[i], any(of_parts.hits));
      ASSERT_EQ(of_whole.near[i], any(of_parts.near));
      ASSERT_EQ(of_whole.distance[i], least(of_parts.distance));
      ASSERT_EQ(of_whole.deepest[i], least(of_parts.deepest));
      // Bodies in slabs are solid, also where time is concerned.
      std::vector<std::uint8_t> crossing(pieces.x.size());
      collide(apart, pieces.agents(), obstacles, crossing);
      float time = least(of_parts.time);
      for (std::size_t p = 0; p < crossing.size(); ++p)
        if (of_parts.hits[p] != 0 && crossing[p] == 0) time = 0;
      ASSERT_EQ(of_whole.time[i], time);
      float depth = 0;
      for (const Penetration& way_out : of_parts.ways) depth = std::max(depth, way_out.depth);
      ASSERT_EQ(of_whole.ways[i].depth, depth);
      // The disc's number counts those of the parts before.
      const auto nearest = std::find(of_parts.deepest.begin(), of_parts.deepest.end(), of_whole.deepest[i]) -
                           of_parts.deepest.begin();
      std::uint32_t before = 0;
      for (std::ptrdiff_t p = 0; p < nearest; ++p)
        before += static_cast<std::uint32_t>(
            apart.discs(pieces.shape[static_cast<std::size_t>(p)], crowd.level[i]).size());
      const auto& of_part = of_parts.deepest_discs[static_cast<std::size_t>(nearest)];
      ASSERT_EQ(of_whole.deepest_discs[i], (DiscPair{before + of_part.first, of_part.second}));
      hits += of_whole.hits[i];
    }
  }
  EXPECT_GT(hits, test::samples(1'000));
}

/// The rows of the whole crowd are what pairs and single obstacles say.
TEST_F(Obstacles, OfTheWholeCrowd) {
  const ObstacleScene scene = test::obstacle_scene(random, 24, 3);
  const ObstacleSet obstacles = scene.set();
  const Crowd crowd = test::crowd_about(random, set, 1000, 3);
  const Agents agents = crowd.agents();
  const ObstacleReference reference(shapes, four_levels, Leaves::segments);
  CrowdCollider collider, other;
  for (int repeat = 0; repeat < 2; ++repeat) {
    const CrowdCollisions found = collider.collide_all(set, agents, obstacles);
    const Rows<std::uint32_t> neighbours = other.collide_all(set, agents);
    ASSERT_TRUE(std::equal(found.agents.values.begin(), found.agents.values.end(), neighbours.values.begin(),
                           neighbours.values.end()));
    ASSERT_EQ(found.obstacles.size(), agents.size());
    for (std::uint32_t i = 0; i < agents.size(); ++i) {
      std::vector<std::uint32_t> expected;
      for (std::uint32_t o = 0; o < scene.reference.size(); ++o)
        if (reference.collides(agents, i, scene.reference[o])) expected.push_back(o);
      ASSERT_EQ(std::vector<std::uint32_t>(found.obstacles[i].begin(), found.obstacles[i].end()), expected)
          << i;
    }
  }
}

/// An agent that has moved by its penetration is free of the segment; where there is one wall, it does not collide any more.
TEST_F(Obstacles, AreLeftByMovingOut) {
  std::size_t moved = 0;
  for (std::uint32_t k = 0; k < test::samples(20'000); ++k) {
    const bool is_pillar = k % 2 == 0;
    ObstacleScene scene;
    const double angle = random.uniform(-4, 4), c = std::cos(angle), s = std::sin(angle);
    const double radius = k % 4 == 0 ? 40 : random.uniform(0.05, 1);
    if (is_pillar)
      scene.add_path({{radius * c, radius * s},
                      {-radius * s, radius * c},
                      {-radius * c, -radius * s},
                      {radius * s, -radius * c}},
                     true);
    else
      scene.add_path({{-2 * c, -2 * s}, {random.uniform(0, 3) * c, 2 * s}}, false);
    scene.end_obstacle(is_pillar);
    const ObstacleSet obstacles = scene.set();
    Crowd crowd = test::crowd_about(random, set, 1, is_pillar ? radius + 0.2 : 2);
    std::vector<Penetration> way(1);
    std::vector<std::uint8_t> hits(1);
    collide(set, crowd.agents(), obstacles, hits, {.leaves = Leaves::discs});
    penetration(set, crowd.agents(), obstacles, way);
    ASSERT_TRUE(hits[0] == 0 || way[0].depth > 0) << k;
    if (way[0].depth == 0) continue;
    // To either side of a line; out of a pillar by its width at most.
    const double widest =
        2 * static_cast<double>(set.bounding_radius(crowd.shape[0])) + (is_pillar ? 2 * radius : 0);
    ASSERT_LE(static_cast<double>(way[0].depth), widest * 1.001) << k;
    ASSERT_NEAR(way[0].x * way[0].x + way[0].y * way[0].y, 1, 1e-8);
    crowd.x[0] += static_cast<double>(way[0].depth) * way[0].x;
    crowd.y[0] += static_cast<double>(way[0].depth) * way[0].y;
    penetration(set, crowd.agents(), obstacles, way);
    collide(set, crowd.agents(), obstacles, hits, {.leaves = Leaves::discs});
    ASSERT_EQ(hits[0], 0) << k << " depth " << way[0].depth;
    ASSERT_EQ(way[0].depth, 0) << k;
    ++moved;
  }
  EXPECT_GT(moved, test::samples(3'000));
}

/// Before the time of impact nothing touches, and then something does.
TEST_F(Obstacles, AreTouchedInTime) {
  std::size_t touched = 0, passed = 0;
  for (std::uint32_t k = 0; k < test::samples(100); ++k) {
    const ObstacleScene scene = test::obstacle_scene(random, 12, 3);
    const ObstacleSet obstacles = scene.set();
    Crowd crowd = test::crowd_about(random, set, 200, 4);
    std::vector<double> dx, dy;
    for (std::size_t i = 0; i < crowd.x.size(); ++i)
      dx.push_back(random.below(5) == 0 ? 0 : random.uniform(-4, 4)), dy.push_back(random.uniform(-4, 4));
    std::vector<float> time(crowd.x.size()), distance(crowd.x.size());
    time_of_impact(set, crowd.agents(), {dx, dy}, obstacles, time);
    const auto clearances_at = [&](const std::vector<double>& share) {
      Crowd moved = crowd;
      for (std::size_t i = 0; i < share.size(); ++i)
        moved.x[i] += share[i] * dx[i], moved.y[i] += share[i] * dy[i];
      clearance(set, moved.agents(), obstacles, {distance});
    };
    std::vector<double> share(time.size());
    for (int sample = 0; sample < 8; ++sample) {
      for (std::size_t i = 0; i < share.size(); ++i)
        share[i] = random.uniform(0, 1) * std::min(1.0, static_cast<double>(time[i]) * (1 - 1e-6));
      clearances_at(share);
      for (std::size_t i = 0; i < share.size(); ++i)
        ASSERT_TRUE(time[i] == 0 || distance[i] > 0)
            << "scene " << k << ", agent " << i << ", time " << time[i];
    }
    for (std::size_t i = 0; i < share.size(); ++i)
      share[i] = std::isinf(time[i]) ? 0 : static_cast<double>(time[i]);
    clearances_at(share);
    for (std::size_t i = 0; i < share.size(); ++i) {
      if (std::isinf(time[i])) {
        ++passed;
        continue;
      }
      ASSERT_LT(distance[i], 1e-5f) << "scene " << k << ", agent " << i << ", time " << time[i];
      touched += time[i] > 0;
    }
  }
  EXPECT_GT(touched, test::samples(1'000));
  EXPECT_GT(passed, test::samples(1'000));
}

TEST_F(Obstacles, MayBeNone) {
  const std::vector<std::uint64_t> none = {0};
  const ObstacleSet obstacles({{}, {}, none});
  EXPECT_EQ(obstacles.obstacle_count(), 0u);
  EXPECT_EQ(obstacles.segment_count(), 0u);
  const Crowd crowd = test::crowd_about(random, set, 10, 3);
  const std::vector<double> way(10, 1.0), distances(1, infinity);
  const Answers all = all_answers(set, crowd.agents(), obstacles, {}, distances, {way, way});
  EXPECT_EQ(all.hits, std::vector<std::uint8_t>(10, 0));
  EXPECT_EQ(all.near, std::vector<std::uint8_t>(10, 0));
  EXPECT_EQ(all.distance, std::vector<float>(10, HUGE_VALF));
  EXPECT_EQ(all.time, std::vector<float>(10, HUGE_VALF));
  EXPECT_EQ(all.ways, std::vector<Penetration>(10));
}

TEST_F(Obstacles, RejectWhatIsWrong) {
  const std::vector<double> x = {0, 1}, y = {0, 1}, bad = {0, std::nan("")}, far = {0, 2e9};
  const std::vector<std::uint64_t> paths = {0, 2}, beyond = {0, 3}, back = {0, 2, 1, 2}, one = {0, 1};
  const std::vector<std::uint8_t> two = {0, 1};
  const auto why = [](const ObstacleArrays& in) { return test::complaint([&] { ObstacleSet{in}; }); };
  EXPECT_EQ(why({x, {}, paths}), "obstacles: 2 values of x but 0 of y");
  EXPECT_EQ(why({x, y, {}}), "obstacles: path offsets do not lead from 0 to 2 points");
  EXPECT_EQ(why({x, y, beyond}), "obstacles: path offsets do not lead from 0 to 2 points");
  EXPECT_EQ(why({x, y, back}), "obstacles: path offsets: 1 after 2");
  EXPECT_EQ(why({x, y, paths, paths}), "obstacles: obstacle offsets do not lead from 0 to 1 paths");
  EXPECT_EQ(why({x, y, paths, one, two}), "obstacles: 1 obstacles but 2 values of is_area");
  EXPECT_EQ(why({bad, y, paths}), "obstacles: point 1: (nan, 1) m is not within +-1e9");
  EXPECT_EQ(why({x, far, paths}), "obstacles: point 1: (1, 2e+09) m is not within +-1e9");
  const ObstacleSet wall({x, y, paths});
  EXPECT_THROW(wall.obstacle_of(1), std::out_of_range);
  const Crowd crowd = test::crowd_about(random, set, 2, 3);
  std::vector<std::uint8_t> hits(3, 7);
  EXPECT_EQ(test::complaint([&] { collide(set, crowd.agents(), wall, hits); }),
            "collide: 2 agents but 3 hits");
  std::vector<float> distance(2);
  EXPECT_EQ(test::complaint([&] { clearance(set, crowd.agents(), wall, {distance}, {.max_distance = -1}); }),
            "clearance: a max_distance of -1 m");
  const std::vector<double> distances = {1, -1};
  hits.resize(2);
  EXPECT_EQ(test::complaint([&] { within(set, crowd.agents(), wall, distances, hits); }),
            "within: agent 1: a distance of -1 m");
  EXPECT_EQ(test::complaint([&] {
              time_of_impact(set, crowd.agents(), {distances, bad}, wall, distance);
            }),
            "time_of_impact: agent 1: displacement (-1, nan) m is not within +-1e9");
  EXPECT_EQ(hits, std::vector<std::uint8_t>(2, 7));
}

}  // namespace
}  // namespace bch
