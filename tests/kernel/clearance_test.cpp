// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/clearance_reference.hpp"
#include "baselines/segment_clearance.hpp"
#include "kernel/simd/gaps.hpp"
#include "layout/base/rounding.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"
#include "tests/support/character_shapes.hpp"
#include "tests/support/differential.hpp"
#include "tests/support/plane_geometry.hpp"
#include "tests/support/query_answers.hpp"
#include "tests/support/test.hpp"
#include "tests/support/touching_scene.hpp"

namespace bch {
namespace {

using test::four_levels;
using test::nearest_features;
using test::NearestFeatures;
using test::PairScene;
using test::Random;

using test::infinity;
constexpr detail::AllOptions deepest{.overlap = Overlap::deepest},
    exact_leaves{.distance_leaves = Leaves::segments};
using Answers = std::vector<NearestFeatures>;

/// Returns the way from the nearest point of a pair's first agent to that of the second, metres.
struct Way {
  double x, y;
};
Way way_between(const NearestPoints& points, const test::Crowd& crowd, Pair pair) {
  const auto& [first, second] = points;
  return {crowd.x[pair.second] - crowd.x[pair.first] + (double{second.x} - double{first.x}),
          crowd.y[pair.second] - crowd.y[pair.first] + (double{second.y} - double{first.y})};
}

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
    const Answers all = nearest_features(finest, scene, deepest);
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
      const auto [a, b] = scene.pairs[i];
      const Shape &shape_a = shapes[agents.shape[a]], &shape_b = shapes[agents.shape[b]];
      const long double exact = test::oracle(shapes, agents, {a, b}).distance();
      const long double found = all[i].distance;
      EXPECT_LE(found, exact) << i;
      if (!(found > 0)) continue;
      ++apart;
      const auto radius = [](const Shape& shape, std::uint32_t node) {
        return static_cast<long double>(
            shape.hierarchy.nodes[cut(shape.hierarchy, all_depths)[node]].disc.radius);
      };
      const long double ra = radius(shape_a, all[i].discs.first), rb = radius(shape_b, all[i].discs.second);
      const long double centres = found + ra + rb,
                        max_extent = shape_a.hierarchy.max_extent + shape_b.hierarchy.max_extent;
      EXPECT_LE(exact - found, ra + rb + (ra * ra + rb * rb) / (2 * centres) + 4e-6L * (max_extent + centres))
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
  const Answers all = nearest_features(set, scene, deepest);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const long double found = all[i].distance;
    EXPECT_LE(found, exact[i]) << i;
    EXPECT_GE(found, exact[i] - 4e-6L * (1 + exact[i])) << i;
  }
}

/// They lie on the edges of the nearest discs, along the direction, and are as far apart as the distance says.
TEST_F(ClearanceDifferential, PointsAreThoseOfTheNearestFeatures) {
  const PairScene scene = random_scene(random, set, 5'000);
  const test::Crowd& crowd = scene.crowd;
  const Answers all = nearest_features(set, scene, deepest);
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const auto [a, b] = scene.pairs[i];
    const double x = all[i].direction.x, y = all[i].direction.y;
    const auto expect_edge = [&](std::uint32_t agent, std::uint32_t number, Vec2 point, double sign) {
      const Disc disc = set.discs(crowd.shape[agent], crowd.level[agent])[number];
      const double c = std::cos(crowd.heading[agent]), s = std::sin(crowd.heading[agent]),
                   r = sign * double{disc.radius}, disc_x = disc.x, disc_y = disc.y;
      EXPECT_NEAR(point.x, c * disc_x - s * disc_y + r * x, 1e-6) << i;
      EXPECT_NEAR(point.y, s * disc_x + c * disc_y + r * y, 1e-6) << i;
    };
    expect_edge(a, all[i].discs.first, all[i].points.first, 1);
    expect_edge(b, all[i].discs.second, all[i].points.second, -1);
    const auto [way_x, way_y] = way_between(all[i].points, crowd, scene.pairs[i]);
    EXPECT_NEAR(way_x * x + way_y * y, all[i].distance, 32e-6) << i;
    EXPECT_NEAR(way_x * y - way_y * x, 0, 32e-6) << i;
  }
}

/// Along x from the first agent of a list to the other one.
TEST(Clearance, OfDiscsInOnePlaceIsAlongX) {
  const std::vector<Shape> shapes = {{{}, detail::fixed_cylinder(0.25f)}, {{}, detail::fixed_cylinder(0.5f)}};
  PairScene scene;
  for (const std::uint32_t shape : {0u, 1u}) scene.crowd.add({shape, 1, 1, 0.7 + shape, 0});
  scene.pairs = {{0, 1}, {1, 0}, {0, 0}};
  for (const ShapeSetPlan& levels : {ShapeSetPlan{{0}}, ShapeSetPlan{}}) {
    const Answers of = nearest_features(ShapeSet(shapes, levels), scene, deepest);
    const float depths[] = {-0.75f, -0.75f, -0.5f}, along[] = {1, -1, 1};
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(of[i].distance, depths[i], 1e-5);
      EXPECT_EQ(of[i].direction, (Vec2{along[i], 0}));
      EXPECT_EQ(of[i].discs, (DiscPair{0, 0}));
    }
  }
}

TEST(Clearance, AnswersThatAreNotAskedForChangeNoOthers) {
  const ShapeSet set(test::synthetic_shapes(6, 8), four_levels);
  Random random(7);
  const PairScene scene = random_scene(random, set, 3'000);
  const Answers all = nearest_features(set, scene, {.max_distance = 0.5, .overlap = Overlap::deepest});
  std::vector<float> distance(scene.pairs.size());
  clearance(set, scene.crowd.agents(), scene.pairs, {distance, {}, {}},
            {.max_distance = 0.5, .overlap = Overlap::deepest});
  EXPECT_TRUE(std::ranges::equal(distance, all, {}, {}, &NearestFeatures::distance));
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
    const Answers apart = nearest_features(set, scene, deepest);
    std::vector<double> distances;
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
      const double clearance = std::max(0.0, static_cast<double>(apart[i].distance));
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
  const Answers apart = nearest_features(set, scene, {});
  std::vector<double> distances = near_clearances(scene);
  for (std::size_t i = 0; i < distances.size(); i += 4)
    distances[i] = std::max(0.0, static_cast<double>(apart[i].distance));  // just so far
  const Hits hits = hits_within(set, scene, distances);
  std::size_t misses = 0, beyond = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const double clearance = apart[i].distance;
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

// ---- clearance() with exact leaves: the distance of the outlines.

TEST_F(ClearanceDifferential, OfDeepestOverlapsIsThatOfDiscs) {
  const PairScene scene = tangent_scene(5'000);
  detail::AllOptions options = exact_leaves;
  options.overlap = Overlap::deepest;
  const Answers found = nearest_features(set, scene, options),
                of_discs = nearest_features(set, scene, deepest);
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) ASSERT_TRUE(found[i] == of_discs[i]) << i;
}

/// Returns how far a point of an agent, as clearance() gives it, is from a segment of its outline.
double distance_from_segment(const Shape& shape, std::uint32_t segment, double heading, Vec2 point) {
  const double c = std::cos(heading), s = std::sin(heading), x = point.x, y = point.y;
  const double own_x = c * x + s * y, own_y = c * y - s * x;
  const auto [from, to] = baselines::LeafSegments::segment(shape.outline, segment);
  return test::distance_to_segment<double>(own_x, own_y, from.x, from.y, to.x, to.y);
}

double distance_from_outline(const Shape& shape, double heading, Vec2 point) {
  double least = infinity;
  for (std::uint32_t i = 0; i < shape.outline.points.size(); ++i)
    least = std::min(least, distance_from_segment(shape, i, heading, point));
  return least;
}

/// Never larger than the distance of the outlines, and below it by no more than pairs.hpp says; and all outputs belong together.
void expect_distances_of_outlines(const std::vector<Shape>& shapes, const PairScene& scene,
                                  const Answers& found) {
  std::size_t apart = 0;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const Pair pair = scene.pairs[i];
    const Shape &a = shapes[scene.crowd.shape[pair.first]], &b = shapes[scene.crowd.shape[pair.second]];
    const baselines::Oracle truth = test::oracle(shapes, scene.crowd.agents(), pair);
    const long double exact = !truth.cross() && truth.nested() ? 0 : truth.distance();
    ASSERT_LE(found[i].distance, exact) << i;
    const bool segments = a.hierarchy.nodes.size() > 1 && b.hierarchy.nodes.size() > 1;
    if (!segments) continue;
    const long double max_extent = a.hierarchy.max_extent + b.hierarchy.max_extent,
                      steps = static_cast<long double>(a.outline.grid_step) + b.outline.grid_step,
                      most = 1.4e-6L * max_extent + detail::rounding::outline_grid_steps * steps +
                             0.9e-6L * exact;
    ASSERT_LE(exact - found[i].distance, most) << i;
    if (found[i].distance == 0) {
      EXPECT_EQ(found[i].discs, DiscPair::none);
      EXPECT_EQ(found[i].direction, (Vec2{0, 0}));
      EXPECT_EQ(found[i].points, NearestPoints{});
      continue;
    }
    ++apart;
    const auto slack = static_cast<double>(most);
    EXPECT_LE(distance_from_outline(a, scene.crowd.heading[pair.first], found[i].points.first), slack) << i;
    EXPECT_LE(distance_from_outline(b, scene.crowd.heading[pair.second], found[i].points.second), slack) << i;
    const auto [way_x, way_y] = way_between(found[i].points, scene.crowd, pair);
    const double x = found[i].direction.x, y = found[i].direction.y, distance = found[i].distance;
    EXPECT_NEAR(std::hypot(x, y), 1, 1e-6) << i;
    EXPECT_NEAR(way_x * x + way_y * y, distance, slack) << i;
    EXPECT_NEAR(way_x * y - way_y * x, 0, slack) << i;
    // The named discs hold the points.
    const auto expect_in_disc = [&](const Shape& shape, std::uint32_t agent, std::uint32_t number,
                                    Vec2 point) {
      const Disc disc = shape.hierarchy.nodes[cut(shape.hierarchy, all_depths)[number]].disc;
      const double c = std::cos(scene.crowd.heading[agent]), s = std::sin(scene.crowd.heading[agent]);
      const double px = point.x, py = point.y;
      const double from_x = c * px + s * py - double{disc.x}, from_y = c * py - s * px - double{disc.y};
      EXPECT_LE(std::hypot(from_x, from_y), double{disc.radius} + slack) << i;
    };
    expect_in_disc(a, pair.first, found[i].discs.first, found[i].points.first);
    expect_in_disc(b, pair.second, found[i].discs.second, found[i].points.second);
  }
  EXPECT_GT(apart, scene.pairs.size() / 10);
}

TEST(SegmentClearanceOfOutlines, IsTheirDistanceForAnySize) {
  Random random(2702);
  const std::vector<Shape> shapes = test::simple_shapes(random, 400);
  const ShapeSet set(shapes);
  const test::TouchingScene scene = test::touching_scene(random, shapes, test::samples(60'000));
  expect_distances_of_outlines(shapes, scene, nearest_features(set, scene, exact_leaves));
}

TEST(SegmentClearanceOfOutlines, IsTheirDistanceFarApart) {
  Random random(2703);
  const std::vector<Shape> shapes = test::simple_shapes(random, 400);
  const ShapeSet set(shapes);
  PairScene scene;
  for (std::uint32_t i = 0; i < test::samples(20'000); ++i) {
    const auto shape = [&] { return random.below(400); };
    const double length = std::pow(10, random.uniform(-3, 5)), angle = random.uniform(-4, 4);
    const std::uint32_t a = shape(), b = shape();
    scene.crowd.add({a, 0, 0, random.uniform(-4, 4), 0});
    scene.crowd.add({b, length * std::cos(angle), length * std::sin(angle), random.uniform(-4, 4), 0});
    scene.pairs.push_back(i % 2 == 0 ? Pair{2 * i, 2 * i + 1} : Pair{2 * i + 1, 2 * i});
  }
  expect_distances_of_outlines(shapes, scene, nearest_features(set, scene, exact_leaves));
}

TEST(SegmentClearanceOfOutlines, IsTheirDistanceForPeople) {
  const std::vector<Shape> shapes = test::pose_shapes(default_male(), 12);
  const ShapeSet set(shapes);
  Random random(2704);
  PairScene scene = random_scene(random, set, 2'000);
  scene.crowd.level.clear();
  expect_distances_of_outlines(shapes, scene, nearest_features(set, scene, exact_leaves));
}

/// Equal distances: copies of one comb, at places on a grid. The first segments count, on every processor.
TEST(SegmentClearanceOfOutlines, NamesTheFirstOfEquallyNearSegments) {
  Outline comb = test::polygon({{-0.5f, -0.25f}, {0.5f, -0.25f}});
  std::vector<Vec2>& points = comb.points;
  for (int tooth = 2; tooth >= -2; --tooth) {
    const auto x = 0.25f * static_cast<float>(tooth);
    points.insert(points.end(), {{x, 0}, {x - 0.0625f, 0.25f}, {x - 0.125f, 0}});
  }
  const std::vector<Shape> shapes = {test::contour_shape(test::polygon(points))};
  const ShapeSet set(shapes);
  const baselines::SegmentClearance reference(shapes, {});
  Random random(2705);
  PairScene scene;
  for (std::uint32_t i = 0; i < test::samples(5'000); ++i) {
    const double quarter = 1.5707963267948966 * random.below(4);
    const auto at = [&] { return 0.25 * (static_cast<int>(random.below(17)) - 8); };
    scene.crowd.add({0, at(), at(), quarter, 0});
    scene.crowd.add({0, at(), at(), quarter + 3.141592653589793 * random.below(2), 0});
    scene.pairs.push_back({2 * i, 2 * i + 1});
  }
  const Answers first = nearest_features(set, scene, exact_leaves);
  for (const Implementation& implementation : test::supported()) {
    detail::AllOptions options = exact_leaves;
    options.implementation = &implementation;
    const Answers found = nearest_features(set, scene, options);
    for (std::size_t i = 0; i < scene.pairs.size(); ++i)
      ASSERT_TRUE(found[i] == first[i]) << implementation.name << ", pair " << i;
  }
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const auto nearest = reference.nearest(scene.crowd.agents(), scene.pairs[i]);
    ASSERT_EQ(first[i].distance, nearest->distance) << i;
    if (first[i].distance == 0) continue;
    const auto [a, b] = scene.pairs[i];
    EXPECT_LT(distance_from_segment(shapes[0], nearest->a, scene.crowd.heading[a], first[i].points.first),
              1e-6);
    EXPECT_LT(distance_from_segment(shapes[0], nearest->b, scene.crowd.heading[b], first[i].points.second),
              1e-6);
  }
}

}  // namespace
}  // namespace bch
