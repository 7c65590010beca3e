// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/obstacle_reference.hpp"
#include "kernel/runtime/all_options.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"
#include "tests/support/obstacle_scenes.hpp"
#include "tests/support/on_threads.hpp"
#include "tests/support/plane_geometry.hpp"
#include "tests/support/test.hpp"

namespace bch {
namespace {

using baselines::ObstacleReference;
using Answers = test::ObstacleAnswers;
using test::all_answers;
using test::Crowd;
using test::distances_for;
using test::ObstacleScene;
using test::Random;
using test::rounded_down;

using test::infinity;
const ShapeSetPlan four_levels{.depths = {0, 3, 6, all_depths}};

using Obstacles = test::ObstacleTest;

/// Returns a vector of an agent's frame in the axes of the world.
Vec2 turned(const Agents& agents, std::uint32_t agent, double x, double y) {
  const double c = std::cos(agents.heading.x()[agent]), s = std::sin(agents.heading.x()[agent]);
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
  const double fraction = square > 0 ? std::clamp((cx * ux + cy * uy) / square, 0.0, 1.0) : 0.0;
  const double to_x = fraction * ux - cx, to_y = fraction * uy - cy;
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

/// The points of a distance of an outline are on the segments that brute force names, as far apart as the distance says, in its direction; and the
/// named leaf holds the one.
void expect_nearest_outline(const Shape& shape, const Agents& agents, std::uint32_t agent,
                            const ObstacleReference::Gap& gap, float distance, const DiscPair& named,
                            Vec2 direction, const NearestPoints& points) {
  constexpr double near = 1e-5;
  const double c = std::cos(agents.heading.x()[agent]), s = std::sin(agents.heading.x()[agent]);
  const double px = points.first.x, py = points.first.y, x = c * px + s * py, y = c * py - s * px;
  const auto [from, to] = baselines::LeafSegments::segment(shape.outline, gap.of_outline);
  EXPECT_LE(test::distance_to_segment<double>(x, y, from.x, from.y, to.x, to.y), near);
  const double to_x = double{points.second.x} - px, to_y = double{points.second.y} - py;
  EXPECT_NEAR(std::hypot(to_x, to_y), double{distance}, near);
  EXPECT_NEAR(double{direction.x} * double{distance}, to_x, near);
  EXPECT_NEAR(double{direction.y} * double{distance}, to_y, near);
  EXPECT_EQ(named.second, gap.segment);
  const std::uint32_t leaf = cut(shape.hierarchy, all_depths)[named.first];
  const Disc disc = shape.hierarchy.nodes[leaf].disc;
  EXPECT_LE(std::hypot(x - double{disc.x}, y - double{disc.y}), double{disc.radius} + near);
  const auto [begin, end] = shape.hierarchy.primitive_ranges[leaf];
  EXPECT_TRUE(std::any_of(shape.hierarchy.source.begin() + begin, shape.hierarchy.source.begin() + end,
                          [&](std::uint32_t number) { return number == gap.of_outline; }));
}

/// Every answer about every agent of many scenes is that of brute force over all discs and segments, on every instruction set.
void expect_brute_force(Random& random, std::span<const Shape> shapes, const ShapeSetPlan& plan,
                        std::uint32_t scenes) {
  const ShapeSet set(shapes, plan);
  const ObstacleReference with_segments(shapes, plan, Leaves::segments),
      with_discs(shapes, plan, Leaves::discs);
  std::size_t hits = 0, held = 0, apart = 0, of_outlines = 0;
  for (std::uint32_t k = 0; k < scenes; ++k) {
    const ObstacleScene scene = test::obstacle_scene(random, 24, 3);
    const ObstacleSet obstacles = scene.set();
    const Crowd crowd = test::crowd_about(random, set, 1000, 3);
    const Agents agents = crowd.agents();
    const std::vector<double> distances = distances_for(random, agents.size());
    std::vector<double> dx, dy;
    for (std::size_t i = 0; i < agents.size(); ++i)
      dx.push_back(random.uniform(-1, 1)), dy.push_back(random.uniform(-1, 1));
    const Leaves leaves = k % 2 == 0 ? Leaves::segments : Leaves::discs;
    const ObstacleReference& reference = k % 2 == 0 ? with_segments : with_discs;
    detail::AllOptions how{.leaves = leaves, .distance_leaves = leaves};
    const Answers best = all_answers(set, agents, obstacles, how, distances, {dx, dy});
    for (const Implementation& each : implementations())
      if (k % 4 < 2 && each.supported()) {
        how.implementation = &each;
        EXPECT_EQ(all_answers(set, agents, obstacles, how, distances, {dx, dy}), best) << each.name;
      }
    for (std::uint32_t i = 0; i < agents.size(); ++i) {
      bool hit = false, is_contained = false;
      for (const auto& obstacle : scene.reference) {
        hit = hit || reference.collides(agents, i, obstacle);
        is_contained = is_contained || reference.outline_contains(agents, i, obstacle) ||
                       (leaves == Leaves::discs ? reference.contains_a_centre(agents, i, obstacle)
                                                : reference.contains_the_outline(agents, i, obstacle));
      }
      const bool by_discs = leaves == Leaves::discs;
      const auto gap = by_discs ? reference.gap(agents, i, scene.reference)
                                : reference.outline_gap(agents, i, scene.reference);
      ASSERT_EQ(best.hits[i], hit) << "scene " << k << ", agent " << i;
      ASSERT_EQ(best.near[i], is_contained || gap.gap <= distances[i]) << "scene " << k << ", agent " << i;
      if (by_discs) {
        ASSERT_EQ(best.deepest[i], rounded_down(gap.gap)) << "scene " << k << ", agent " << i;
        ASSERT_EQ(best.deepest_discs[i], (DiscPair{gap.disc, gap.segment}));
      }
      const bool zero = is_contained || gap.gap <= 0, of_outline = gap.of_outline != ObstacleReference::none;
      ASSERT_EQ(best.distance[i], zero ? 0 : rounded_down(gap.gap)) << "scene " << k << ", agent " << i;
      ASSERT_TRUE(zero || best.deepest[i] <= best.distance[i]) << "scene " << k << ", agent " << i;
      ASSERT_TRUE(!hit || zero || !of_outline) << "scene " << k << ", agent " << i;
      if (zero || !of_outline) {
        ASSERT_EQ(best.discs[i], zero ? DiscPair::none : (DiscPair{gap.disc, gap.segment}));
      }
      if (zero) {
        ASSERT_EQ(best.direction[i], Vec2{});
        ASSERT_EQ(best.points[i], NearestPoints{});
      } else if (of_outline) {
        expect_nearest_outline(shapes[agents.shape[i]], agents, i, gap, best.distance[i], best.discs[i],
                               best.direction[i], best.points[i]);
        ++of_outlines;
      } else if (i % 8 == 0) {
        expect_nearest(set, agents, i, scene, best.distance[i], best.discs[i], best.direction[i],
                       best.points[i]);
      }
      hits += hit, held += is_contained, apart += !zero;
    }
  }
  const std::size_t all = std::size_t{scenes} * 1000;
  EXPECT_GT(hits, all / 7);
  EXPECT_GT(held, all / 20);
  EXPECT_GT(apart, all / 7);
  EXPECT_TRUE(!set.exact_leaves() || of_outlines > all / 50);
}

TEST_F(Obstacles, AreAsBruteForceSays) {
  expect_brute_force(random, shapes, four_levels, test::samples(160));
}

TEST_F(Obstacles, OfSingleDiscsAreAsBruteForceSays) {
  expect_brute_force(random, shapes, {.depths = {0}}, test::samples(24));
  const Disc five[] = {{0, -0.2f, 0.1f}, {0, -0.1f, 0.12f}, {0, 0, 0.13f}, {0, 0.1f, 0.12f}, {0, 0.2f, 0.1f}};
  std::vector<Shape> own = {shape_from_discs(five)};
  own.push_back({});
  own.back().hierarchy = detail::fixed_cylinder(0.25f);
  expect_brute_force(random, own, {.depths = {0, all_depths}}, test::samples(24));
}

/// Scenes and agents moved far away by distances that are exact have the same answers, of any number of threads.
TEST_F(Obstacles, AnswerFarAwayAsAtTheOrigin) {
  const auto exact = [](double value) { return std::round(value * 0x1p20) * 0x1p-20; };
  ObstacleScene scene = test::obstacle_scene(random, 40, 3);
  Crowd crowd = test::crowd_about(random, set, 3000, 3);
  for (auto* values : {&scene.x, &scene.y, &crowd.x, &crowd.y})
    for (double& value : *values) value = exact(value);
  const std::vector<double> distances = distances_for(random, crowd.x.size());
  std::vector<double> way(crowd.x.size());
  for (double& length : way) length = random.uniform(-1, 1);
  const Answers here = all_answers(set, crowd.agents(), scene.set(), {}, distances, {way, way});
  const detail::AllOptions exact_distances{.distance_leaves = Leaves::segments};
  const Answers outlines =
      all_answers(set, crowd.agents(), scene.set(), exact_distances, distances, {way, way});
  const auto move = [&](double by) {
    for (auto* values : {&scene.x, &crowd.x})
      for (double& value : *values) value += by;
    for (auto* values : {&scene.y, &crowd.y})
      for (double& value : *values) value -= by;
  };
  for (const double far : {0x1p20, 0x1p27, 0x1.8p29}) {
    move(far);
    test::on_threads(4, [&] {
      EXPECT_EQ(all_answers(set, crowd.agents(), scene.set(), {}, distances, {way, way}), here) << far;
      EXPECT_EQ(all_answers(set, crowd.agents(), scene.set(), exact_distances, distances, {way, way}),
                outlines)
          << far;
    });
    move(-far);
  }
}

/// A wall of 2e8 m is where it is next to an agent, and so is one whose near end is far away.
TEST_F(Obstacles, MayBeLong) {
  const ShapeSet discs(std::vector<Shape>{{{}, detail::fixed_cylinder(0.25f)}});
  const double far = 1e8;
  for (const double gap : {-1e-6, 3e-6}) {
    Crowd crowd;
    crowd.add({0, 3, 0.25 + gap, 0.3, 0});
    crowd.add({0, far - 1, 0.25 + gap, 0.3, 0});
    crowd.add({0, -far - 0.25 - gap, 0, 0.3, 0});
    std::vector<std::uint8_t> hits(3);
    collide(discs, crowd.agents(), obstacles_from_wkt("LINESTRING(-1e8 0, 1e8 0)"), hits);
    EXPECT_EQ(hits, std::vector<std::uint8_t>(3, gap < 0)) << gap;
  }
}

/// The rows of the whole crowd are what pairs and single obstacles say.
TEST_F(Obstacles, OfTheWholeCrowd) {
  const ObstacleScene scene = test::obstacle_scene(random, 24, 3);
  const ObstacleSet obstacles = scene.set();
  const Crowd crowd = test::crowd_about(random, set, 1000, 3);
  const Agents agents = crowd.agents();
  const ObstacleReference reference(shapes, four_levels, Leaves::segments);
  bch::Crowd collider;
  for (int repeat = 0; repeat < 2; ++repeat) {
    const Rows<std::uint32_t> found = collider.obstacles(set, agents, obstacles);
    ASSERT_EQ(found.size(), agents.size());
    for (std::uint32_t i = 0; i < agents.size(); ++i) {
      std::vector<std::uint32_t> expected;
      for (std::uint32_t o = 0; o < scene.reference.size(); ++o)
        if (reference.collides(agents, i, scene.reference[o])) expected.push_back(o);
      ASSERT_EQ(std::vector<std::uint32_t>(found[i].begin(), found[i].end()), expected) << i;
    }
  }
}

TEST_F(Obstacles, MayBeNone) {
  const ObstacleSet obstacles = ObstacleScene().set();
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

}  // namespace
}  // namespace bch
