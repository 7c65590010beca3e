// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/clearance.hpp>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <bch/collide.hpp>

#include "baselines/clearance_reference.hpp"
#include "baselines/oracle.hpp"
#include "tests/support/clearances.hpp"
#include "tests/support/differential.hpp"

namespace bch {
namespace {

using baselines::ClearanceReference;
using baselines::Method;
using test::answers;
using test::Answers;
using test::four_levels;
using test::PairScene;
using test::Random;

constexpr double infinity = std::numeric_limits<double>::infinity();

class ClearanceDifferential : public test::Differential {
 protected:
  ClearanceDifferential() : Differential(2601, four_levels) {}

  ClearanceReference reference{shapes, four_levels};

  void expect_equal_to_brute_force(const PairScene& scene, double max_distance, const std::string& what) {
    const Answers deepest = answers(reference, scene, max_distance, Method::brute_force);
    expect_equal(scene, max_distance, Overlap::deepest, deepest, what);
    expect_equal(scene, max_distance, Overlap::zero, test::at_least_zero(deepest), what + ", at least 0");
  }

  void expect_equal(const PairScene& scene, double max_distance, Overlap overlap, const Answers& brute_force,
                    const std::string& what) {
    for (const auto& implementation : implementations()) {
      if (!implementation.supported()) continue;
      const Answers of =
          answers(set, scene.crowd.agents(), scene.pairs, max_distance, &implementation, overlap);
      for (std::size_t i = 0; i < scene.pairs.size(); ++i)
        ASSERT_TRUE(of.same(i, brute_force, i))
            << what << ", " << implementation.name << ", pair " << i << ": " << of.distance[i] << " between "
            << of.discs[i].first << " and " << of.discs[i].second << ", expected " << brute_force.distance[i]
            << " between " << brute_force.discs[i].first << " and " << brute_force.discs[i].second;
    }
  }
};

TEST_F(ClearanceDifferential, RandomPairs) {
  for (const double max_distance : {infinity, 0.5, 0.05, 0.0})
    for (int i = 0; i < 2; ++i)
      expect_equal_to_brute_force(random_scene(random, set, 25'000), max_distance,
                                  "at most " + std::to_string(max_distance));
}

TEST_F(ClearanceDifferential, NearTangentPairs) {
  for (const double max_distance : {infinity, 0.5, 1e-6, 0.0})
    expect_equal_to_brute_force(tangent_scene(12'500), max_distance,
                                "tangent, at most " + std::to_string(max_distance));
}

TEST_F(ClearanceDifferential, FarFromTheOriginAndFarApart) {
  PairScene scene = random_scene(random, set, 25'000);
  const Answers at_origin = answers(set, scene.crowd.agents(), scene.pairs, infinity);
  test::move_away(scene, 1e7, -8e8);
  expect_equal_to_brute_force(scene, infinity, "far from the origin");
  const Answers far = answers(set, scene.crowd.agents(), scene.pairs, infinity);
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) EXPECT_TRUE(far.same(i, at_origin, i)) << i;
  for (const double apart : {30.0, 1e4, 1.4e9}) {
    scene = random_scene(random, set, 8'000);
    for (std::size_t i = 1; i < scene.crowd.x.size(); i += 2) scene.crowd.x[i] -= apart;
    if (apart > 1e9)
      for (double& x : scene.crowd.x) x += 0.5e9;
    expect_equal_to_brute_force(scene, infinity, "far apart: " + std::to_string(apart));
    expect_equal_to_brute_force(scene, apart, "far apart, limited: " + std::to_string(apart));
  }
}

TEST_F(ClearanceDifferential, ManyShapesAnswerLikeOneOfEach) {
  PairScene scene = random_scene(random, set, 5'000);
  const Answers of_one = answers(set, scene.crowd.agents(), scene.pairs, 0.5);
  const ShapeSet large(test::repeated(shapes), four_levels);
  for (std::size_t i = 0; i < scene.crowd.shape.size(); ++i)
    scene.crowd.shape[i] += static_cast<std::uint32_t>(i * shapes.size() % large.shape_count());
  for (const auto& implementation : implementations()) {
    if (!implementation.supported()) continue;
    const Answers of_many = answers(large, scene.crowd.agents(), scene.pairs, 0.5, &implementation);
    for (std::size_t i = 0; i < scene.pairs.size(); ++i)
      ASSERT_TRUE(of_many.same(i, of_one, i)) << implementation.name << ", pair " << i;
  }
}

/// Many gaps that are equal: copies of one disc set, unturned, at places on a grid.
TEST_F(ClearanceDifferential, OfEqualGapsTheFirstCounts) {
  PairScene scene;
  for (std::uint32_t i = 0; i < test::samples(10'000); ++i) {
    const std::uint32_t shape = random.below(static_cast<std::uint32_t>(shapes.size()));
    const double quarter = 1.5707963267948966 * random.below(4);
    const auto at = [&] { return 0.25 * (static_cast<int>(random.below(9)) - 4); };
    const auto level = static_cast<std::uint8_t>(random.below(4));
    scene.crowd.add({shape, at(), at(), quarter, level});
    scene.crowd.add({shape, at(), at(), quarter, level});
    scene.pairs.push_back({2 * i, 2 * i + 1});
  }
  expect_equal_to_brute_force(scene, infinity, "equal gaps");
}

TEST_F(ClearanceDifferential, TheReferencesAgree) {
  const PairScene scene = tangent_scene(10'000);
  for (const double max_distance : {infinity, 0.1}) {
    const Answers slow = answers(reference, scene, max_distance, Method::brute_force),
                  fast = answers(reference, scene, max_distance, Method::depth_first);
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) ASSERT_TRUE(fast.same(i, slow, i)) << i;
  }
}

TEST_F(ClearanceDifferential, BatchesAndThreads) {
  const PairScene scene = random_scene(random, set, 20'000);
  const Answers whole = answers(set, scene.crowd.agents(), scene.pairs, 0.5);
  for (const std::size_t size : {0, 1, 3, 17, 255, 257, 1025})
    for (const std::size_t offset : {0, 1, 62}) {
      const Answers part =
          answers(set, scene.crowd.agents(), std::span(scene.pairs).subspan(offset, size), 0.5);
      for (std::size_t i = 0; i < size; ++i)
        EXPECT_TRUE(part.same(i, whole, offset + i)) << size << ' ' << offset;
    }
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
  for (int threads = 1; threads <= 8; ++threads) {
    tbb::task_arena arena(threads);
    const Answers of = arena.execute([&] { return answers(set, scene.crowd.agents(), scene.pairs, 0.5); });
    for (std::size_t i = 0; i < scene.pairs.size(); ++i)
      ASSERT_TRUE(of.same(i, whole, i)) << threads << " threads";
  }
}

TEST_F(ClearanceDifferential, ExchangedAgentsExchangeNodesAndTurnTheDirection) {
  PairScene scene = tangent_scene(20'000);
  const Answers one = answers(set, scene.crowd.agents(), scene.pairs, infinity);
  for (Pair& pair : scene.pairs) std::swap(pair.first, pair.second);
  const Answers other = answers(set, scene.crowd.agents(), scene.pairs, infinity);
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    EXPECT_EQ(other.distance[i], one.distance[i]);
    EXPECT_EQ(other.direction[i], (Vec2{-one.direction[i].x, -one.direction[i].y}));
    EXPECT_EQ(other.discs[i], (DiscPair{one.discs[i].second, one.discs[i].first}));
  }
}

/// What clearance.hpp says of both. Cut discs that overlap are no collision where nodes above them are apart, and brute
/// force knows that of every pair that is deeper than rounding goes.
TEST_F(ClearanceDifferential, AgreesWithCollide) {
  constexpr float rounding_of_both = 32e-6f;  // shapes reach up to 4 m
  // At random none is within the margins of an overlap; at the edge of one, a sixth of the pairs are.
  const std::pair<PairScene, double> scenes[] = {{random_scene(random, set, 50'000), 1e-4},
                                                 {tangent_scene(50'000), 0.2}};
  for (const auto& [scene, most] : scenes) {
    const Agents agents = scene.crowd.agents();
    std::vector<std::uint8_t> hits(scene.pairs.size());
    collide(set, agents, scene.pairs, hits);
    const Answers all = answers(set, agents, scene.pairs, 0);
    std::size_t disputed = 0, parted_above = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
      if (hits[i]) {
        ASSERT_LE(all.distance[i], 0) << i;
        continue;
      }
      if (!std::isfinite(all.distance[i])) continue;
      const bool deep = all.distance[i] < -rounding_of_both;
      ++(deep ? parted_above : disputed);
      if (deep) {
        EXPECT_FALSE(discs.boundary(agents, scene.pairs[i], Method::brute_force)) << i;
      }
    }
    EXPECT_LE(static_cast<double>(disputed), most * static_cast<double>(hits.size()));
    EXPECT_GT(parted_above, hits.size() / 1000);
  }
}

/// Never larger than the distance of the outlines, and below it by no more than clearance.hpp says.
TEST_F(ClearanceDifferential, BoundsTheDistanceOfTheOutlines) {
  std::vector<Shape> whole = shapes;
  const ShapeSet finest(whole);
  std::vector<PairScene> scenes;
  for (const std::uint32_t pairs : {700, 500, 300, 300})
    scenes.push_back(random_scene(random, finest, test::samples(pairs)));
  for (std::size_t i = 1; i < scenes[1].crowd.x.size(); i += 2)
    scenes[1].crowd.x[i] += random.uniform(-100, 100);
  make_tangent(random, scenes[2], [&](const Agents& agents, Pair pair) {
    return baselines::Oracle(shapes[agents.shape[pair.first]].outline,
                             shapes[agents.shape[pair.second]].outline,
                             baselines::exact_placement(agents, pair.first, pair.second))
        .cross();
  });
  test::move_away(scenes[3], 1e7, -8e8);
  std::size_t apart = 0;
  for (const PairScene& scene : scenes) {
    const Agents agents = scene.crowd.agents();
    const Answers all = answers(finest, agents, scene.pairs, infinity);
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
      const auto [a, b] = scene.pairs[i];
      const Shape &shape_a = shapes[agents.shape[a]], &shape_b = shapes[agents.shape[b]];
      const long double exact =
          baselines::Oracle(shape_a.outline, shape_b.outline, baselines::exact_placement(agents, a, b))
              .distance();
      const long double found = all.distance[i];
      EXPECT_LE(found, exact) << i;
      if (!(found > 0)) continue;
      ++apart;
      const auto radius = [](const Shape& shape, std::uint32_t node) {
        return static_cast<long double>(
            shape.hierarchy.nodes[cut(shape.hierarchy, all_depths)[node]].disc.radius);
      };
      const long double ra = radius(shape_a, all.discs[i].first), rb = radius(shape_b, all.discs[i].second);
      const long double centres = found + ra + rb, reach = shape_a.hierarchy.reach + shape_b.hierarchy.reach;
      EXPECT_LE(exact - found, ra + rb + (ra * ra + rb * rb) / (2 * centres) + 4e-6L * (reach + centres))
          << i;
    }
  }
  EXPECT_GT(apart, test::samples(500));
}

/// Tip against tip nothing but the margins is between the answer and the outlines, at any distance.
TEST(Clearance, OfTipsIsTheDistanceOfTheOutlinesLessTheMargin) {
  const std::vector<Shape> shapes = {test::contour_shape(test::needle())};
  const ShapeSet set(shapes);
  Random random(11);
  test::PairScene scene;
  std::vector<long double> exact;
  for (std::uint32_t i = 0; i < test::samples(4'000); ++i) {
    const double angle = random.uniform(-4, 4), length = 0.8 + std::pow(10, random.uniform(-6, 3));
    const double x = random.uniform(-50, 50), y = random.uniform(-50, 50);
    scene.crowd.add({0, x, y, angle, 0});
    scene.crowd.add(
        {0, x + length * std::cos(angle), y + length * std::sin(angle), angle + std::numbers::pi, 0});
    scene.pairs.push_back({2 * i, 2 * i + 1});
    exact.push_back(baselines::Oracle(shapes[0].outline, shapes[0].outline,
                                      baselines::exact_placement(scene.crowd.agents(), 2 * i, 2 * i + 1))
                        .distance());
  }
  const Answers all = answers(set, scene.crowd.agents(), scene.pairs, infinity);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const long double found = all.distance[i];
    EXPECT_LE(found, exact[i]) << i;
    EXPECT_GE(found, exact[i] - 4e-6L * (1 + exact[i])) << i;
  }
}

std::vector<NearestPoints> points_of(const ShapeSet& set, const PairScene& scene, const Answers& all) {
  std::vector<float> distance(scene.pairs.size());
  std::vector<NearestPoints> points(scene.pairs.size());
  clearance(set, scene.crowd.agents(), scene.pairs, {.distance = distance, .points = points},
            {.overlap = Overlap::deepest});
  EXPECT_EQ(distance, all.distance);
  return points;
}

/// They lie on the edges of the nearest discs, along the direction, and are as far apart as the distance says.
TEST_F(ClearanceDifferential, PointsAreThoseOfTheNearestFeatures) {
  const PairScene scene = random_scene(random, set, 5'000);
  const test::Crowd& crowd = scene.crowd;
  const Answers all = answers(set, crowd.agents(), scene.pairs, infinity);
  const std::vector<NearestPoints> points = points_of(set, scene, all);
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const auto [a, b] = scene.pairs[i];
    const double x = all.direction[i].x, y = all.direction[i].y;
    const auto expect_edge = [&](std::uint32_t agent, std::uint32_t number, Vec2 point, double sign) {
      const Disc disc = set.discs(crowd.shape[agent], crowd.level[agent])[number];
      const double c = std::cos(crowd.heading[agent]), s = std::sin(crowd.heading[agent]),
                   r = sign * double{disc.radius}, disc_x = disc.x, disc_y = disc.y;
      EXPECT_NEAR(point.x, c * disc_x - s * disc_y + r * x, 1e-6) << i;
      EXPECT_NEAR(point.y, s * disc_x + c * disc_y + r * y, 1e-6) << i;
    };
    expect_edge(a, all.discs[i].first, points[i].first, 1);
    expect_edge(b, all.discs[i].second, points[i].second, -1);
    const auto [way_x, way_y] = test::way_between(points[i], crowd, scene.pairs[i]);
    EXPECT_NEAR(way_x * x + way_y * y, all.distance[i], 32e-6) << i;
    EXPECT_NEAR(way_x * y - way_y * x, 0, 32e-6) << i;
  }
}

TEST_F(ClearanceDifferential, PointsAreTheSameFarFromTheOriginAndInTheOtherOrder) {
  PairScene scene = random_scene(random, set, 5'000);
  test::move_away(scene, 0, 0);
  const Answers all = answers(set, scene.crowd.agents(), scene.pairs, infinity);
  const std::vector<NearestPoints> points = points_of(set, scene, all);
  test::move_away(scene, 1e7, -8e8);
  EXPECT_EQ(points_of(set, scene, all), points);
  for (Pair& pair : scene.pairs) std::swap(pair.first, pair.second);
  const std::vector<NearestPoints> exchanged = points_of(set, scene, all);
  for (std::size_t i = 0; i < points.size(); ++i)
    ASSERT_EQ(exchanged[i], (NearestPoints{points[i].second, points[i].first})) << i;
}

/// Moving the second agent along the direction widens the gap of the nearest discs by as much.
TEST_F(ClearanceDifferential, DirectionsAreUnitVectorsAlongWhichDiscsPart) {
  const PairScene scene = random_scene(random, set, 5'000);
  const Answers all = answers(set, scene.crowd.agents(), scene.pairs, infinity);
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const double x = all.direction[i].x, y = all.direction[i].y;
    EXPECT_NEAR(std::hypot(x, y), 1, 1e-6);
    test::Crowd moved;
    for (const std::uint32_t agent : {scene.pairs[i].first, scene.pairs[i].second}) {
      const test::Crowd& crowd = scene.crowd;
      moved.add(
          {crowd.shape[agent], crowd.x[agent], crowd.y[agent], crowd.heading[agent], crowd.level[agent]});
    }
    moved.x[1] += 0.001 * x, moved.y[1] += 0.001 * y;
    const std::vector<Pair> pair = {{0, 1}};
    const Answers after = answers(set, moved.agents(), pair, infinity);
    EXPECT_LE(after.distance[0], all.distance[i] + 0.00101f) << i;
    if (after.discs[0] == all.discs[i]) {
      EXPECT_NEAR(after.distance[0] - all.distance[i], 0.001, 1e-5) << i;
    }
  }
}

}  // namespace
}  // namespace bch
