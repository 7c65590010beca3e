// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/clearance_reference.hpp"
#include "kernel/runtime/all_options.hpp"
#include "kernel/simd/gaps.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"
#include "tests/support/clearances.hpp"
#include "tests/support/differential.hpp"
#include "tests/support/test.hpp"
#include "tests/support/touching_scene.hpp"

namespace bch {
namespace {

using test::answers;
using test::Answers;
using test::four_levels;
using test::PairScene;
using test::Random;

constexpr double infinity = std::numeric_limits<double>::infinity();

class ClearanceDifferential : public test::Differential {
 protected:
  ClearanceDifferential() : Differential(2601, four_levels) {}
};

/// Never larger than the distance of the outlines, and below it by no more than pairs.hpp says.
TEST_F(ClearanceDifferential, BoundsTheDistanceOfTheOutlines) {
  const ShapeSet finest(shapes);
  std::vector<PairScene> scenes;
  for (const std::uint32_t pairs : {700, 500, 300, 300})
    scenes.push_back(random_scene(random, finest, test::samples(pairs)));
  for (std::size_t i = 1; i < scenes[1].crowd.x.size(); i += 2)
    scenes[1].crowd.x[i] += random.uniform(-100, 100);
  make_tangent(random, scenes[2],
               [&](const Agents& agents, Pair pair) { return test::oracle(shapes, agents, pair).cross(); });
  test::move_away(scenes[3], 1e7, -8e8);
  std::size_t apart = 0;
  for (const PairScene& scene : scenes) {
    const Agents agents = scene.crowd.agents();
    const Answers all = answers(finest, agents, scene.pairs, infinity);
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
      const auto [a, b] = scene.pairs[i];
      const Shape &shape_a = shapes[agents.shape[a]], &shape_b = shapes[agents.shape[b]];
      const long double exact = test::oracle(shapes, agents, {a, b}).distance();
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
    exact.push_back(test::oracle(shapes, scene.crowd.agents(), scene.pairs[i]).distance());
  }
  const Answers all = answers(set, scene.crowd.agents(), scene.pairs, infinity);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const long double found = all.distance[i];
    EXPECT_LE(found, exact[i]) << i;
    EXPECT_GE(found, exact[i] - 4e-6L * (1 + exact[i])) << i;
  }
}

/// They lie on the edges of the nearest discs, along the direction, and are as far apart as the distance says.
TEST_F(ClearanceDifferential, PointsAreThoseOfTheNearestFeatures) {
  const PairScene scene = random_scene(random, set, 5'000);
  const test::Crowd& crowd = scene.crowd;
  Answers all(scene.pairs.size());
  std::vector<NearestPoints> points(scene.pairs.size());
  clearance(set, crowd.agents(), scene.pairs, {all.distance, all.direction, all.discs, points},
            {.overlap = Overlap::deepest});
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

/// Along x from the first agent of a list to the other one.
TEST(Clearance, OfDiscsInOnePlaceIsAlongX) {
  const std::vector<Shape> shapes = {{{}, detail::fixed_cylinder(0.25f)}, {{}, detail::fixed_cylinder(0.5f)}};
  test::Crowd crowd;
  for (const std::uint32_t shape : {0u, 1u}) crowd.add({shape, 1, 1, 0.7 + shape, 0});
  const std::vector<Pair> pairs = {{0, 1}, {1, 0}, {0, 0}};
  for (const ShapeSetPlan& levels : {ShapeSetPlan{{0}}, ShapeSetPlan{}}) {
    const Answers of = answers(ShapeSet(shapes, levels), crowd.agents(), pairs, infinity);
    const float depths[] = {-0.75f, -0.75f, -0.5f}, along[] = {1, -1, 1};
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(of.distance[i], depths[i], 1e-5);
      EXPECT_EQ(of.direction[i], (Vec2{along[i], 0}));
      EXPECT_EQ(of.discs[i], (DiscPair{0, 0}));
    }
  }
}

TEST(Clearance, AnswersThatAreNotAskedForChangeNoOthers) {
  const ShapeSet set(test::synthetic_shapes(6, 8), four_levels);
  Random random(7);
  const PairScene scene = random_scene(random, set, 3'000);
  const Answers all = answers(set, scene.crowd.agents(), scene.pairs, 0.5);
  std::vector<float> distance(scene.pairs.size());
  clearance(set, scene.crowd.agents(), scene.pairs, {distance, {}, {}},
            {.max_distance = 0.5, .overlap = Overlap::deepest});
  EXPECT_EQ(distance, all.distance);
}

using Hits = std::vector<std::uint8_t>;

Hits hits_within(const ShapeSet& set, const PairScene& scene, std::span<const double> distances,
                 const detail::AllOptions& options = {}) {
  Hits hits(scene.pairs.size());
  within(set, scene.crowd.agents(), scene.pairs, distances, hits, options);
  return hits;
}

class Within : public test::Differential {
 protected:
  Within() : Differential(2701, four_levels) {}

  PairScene scene_of(std::uint32_t pairs, double apart = 1) {
    PairScene scene = random_scene(random, set, pairs);
    for (std::size_t i = 1; i < scene.crowd.x.size(); i += 2)
      scene.crowd.x[i] += random.uniform(-apart, apart);
    return scene;
  }

  /// Draws distances of which many are as the pairs' clearances but for some bits, and some are none or infinite.
  std::vector<double> near_clearances(const PairScene& scene) {
    const test::Answers apart = test::answers(set, scene.crowd.agents(), scene.pairs, infinity);
    std::vector<double> distances;
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
      const double clearance = std::max(0.0, static_cast<double>(apart.distance[i]));
      switch (random.below(8)) {
        case 0:
          distances.push_back(random.uniform(0, 2));
          break;
        case 1:
          distances.push_back(random.below(2) == 0 ? 0 : infinity);
          break;
        default:
          distances.push_back(clearance * (1 + random.uniform(-2e-6, 0.5e-6)));
      }
    }
    return distances;
  }

  /// Returns the sum of the radii of the largest discs of two agents.
  double largest_radii(const Agents& agents, std::size_t first) const {
    double sum = 0;
    for (const std::size_t agent : {first, first + 1}) {
      float largest = 0;
      for (const Disc& disc : set.discs(agents.shape[agent], agents.level[agent]))
        largest = std::max(largest, disc.radius);
      sum += static_cast<double>(largest);
    }
    return sum;
  }
};

/// What pairs.hpp says of both, at distances around the clearances.
TEST_F(Within, AgreesWithClearanceButForItsMargin) {
  const PairScene scene = scene_of(40'000);
  const Agents agents = scene.crowd.agents();
  const test::Answers apart = test::answers(set, agents, scene.pairs, infinity, nullptr, Overlap::zero);
  std::vector<double> distances = near_clearances(scene);
  for (std::size_t i = 0; i < distances.size(); i += 4)
    distances[i] = std::max(0.0, static_cast<double>(apart.distance[i]));  // just so far
  const Hits hits = hits_within(set, scene, distances);
  std::size_t misses = 0, beyond = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const double clearance = apart.distance[i];
    if (clearance <= distances[i]) {
      ASSERT_EQ(hits[i], 1) << i;
    } else if (hits[i]) {
      ASSERT_LE(clearance, distances[i] + detail::gap_price * (distances[i] + largest_radii(agents, 2 * i)))
          << i;
      ++beyond;
    }
    misses += hits[i] == 0;
  }
  EXPECT_GT(misses, hits.size() / 50);
  EXPECT_GT(beyond, hits.size() / 100);  // the margin is looked at
}

TEST_F(Within, AnswersAreOnesWhereOutlinesAreAsClose) {
  const PairScene scene = scene_of(test::samples(600));
  const Agents agents = scene.crowd.agents();
  std::vector<double> distances;
  for (const Pair pair : scene.pairs) {
    const long double apart = test::oracle(shapes, agents, pair).distance();
    distances.push_back(std::nextafter(static_cast<double>(apart), infinity));
  }
  const Hits hits = hits_within(set, scene, distances);
  for (std::size_t i = 0; i < hits.size(); ++i) EXPECT_EQ(hits[i], 1) << i;
}

TEST_F(Within, OneDistanceServesAllPairs) {
  const PairScene scene = scene_of(3'000);
  for (const double distance : {0.0, 0.1, infinity})
    EXPECT_EQ(hits_within(set, scene, {&distance, 1}),
              hits_within(set, scene, std::vector<double>(scene.pairs.size(), distance)));
  const double all = infinity;
  EXPECT_EQ(hits_within(set, scene, {&all, 1}), Hits(scene.pairs.size(), 1));
}

}  // namespace
}  // namespace bch
