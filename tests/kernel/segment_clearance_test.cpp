// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/segment_clearance.hpp"
#include "kernel/runtime/all_options.hpp"
#include "layout/base/rounding.hpp"
#include "tests/support/character_shapes.hpp"
#include "tests/support/clearances.hpp"
#include "tests/support/differential.hpp"
#include "tests/support/test.hpp"
#include "tests/support/touching_scene.hpp"

// clearance() with exact leaves: the distance of the outlines.

namespace bch {
namespace {

using test::PairScene;
using test::Random;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// All outputs.
struct Found : test::Answers {
  explicit Found(std::size_t size) : Answers(size), points(size) {}
  std::vector<NearestPoints> points;

  bool same(std::size_t i, const Found& other, std::size_t k) const {
    return Answers::same(i, other, k) && points[i] == other.points[k];
  }
};

Found find(const ShapeSet& set, const PairScene& scene, detail::AllOptions options = {}) {
  options.distance_leaves = Leaves::segments;
  Found found(scene.pairs.size());
  clearance(set, scene.crowd.agents(), scene.pairs,
            {found.distance, found.direction, found.discs, found.points}, options);
  return found;
}

class SegmentClearance : public test::Differential {
 protected:
  SegmentClearance() : Differential(2701, test::four_levels) {}
};

TEST_F(SegmentClearance, DeepestOverlapsAreThoseOfDiscs) {
  const PairScene scene = tangent_scene(5'000);
  const Found found = find(set, scene, {.overlap = Overlap::deepest});
  const test::Answers of_discs = test::answers(set, scene.crowd.agents(), scene.pairs, infinity);
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) ASSERT_TRUE(found.Answers::same(i, of_discs, i)) << i;
}

/// Returns how far a point of an agent, as clearance() gives it, is from a segment of its outline.
double distance_from_segment(const Shape& shape, std::uint32_t segment, double heading, Vec2 point) {
  const double c = std::cos(heading), s = std::sin(heading), x = point.x, y = point.y;
  const double own_x = c * x + s * y, own_y = c * y - s * x;
  const auto [from, to] = baselines::LeafSegments::segment(shape.outline, segment);
  const double way_x = to.x - from.x, way_y = to.y - from.y, square = way_x * way_x + way_y * way_y;
  const double share =
      square > 0 ? std::clamp(((own_x - from.x) * way_x + (own_y - from.y) * way_y) / square, 0.0, 1.0) : 0;
  return std::hypot(own_x - from.x - share * way_x, own_y - from.y - share * way_y);
}

double distance_from_outline(const Shape& shape, double heading, Vec2 point) {
  double least = infinity;
  for (std::uint32_t i = 0; i < shape.outline.points.size(); ++i)
    least = std::min(least, distance_from_segment(shape, i, heading, point));
  return least;
}

/// Never larger than the distance of the outlines, and below it by no more than pairs.hpp says; and all outputs belong together.
void expect_distances_of_outlines(const std::vector<Shape>& shapes, const PairScene& scene,
                                  const Found& found) {
  std::size_t apart = 0;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const Pair pair = scene.pairs[i];
    const Shape &a = shapes[scene.crowd.shape[pair.first]], &b = shapes[scene.crowd.shape[pair.second]];
    const baselines::Oracle truth = test::oracle(shapes, scene.crowd.agents(), pair);
    const long double exact = !truth.cross() && truth.nested() ? 0 : truth.distance();
    ASSERT_LE(found.distance[i], exact) << i;
    const bool segments = a.hierarchy.nodes.size() > 1 && b.hierarchy.nodes.size() > 1;
    if (!segments) continue;
    const long double reach = a.hierarchy.reach + b.hierarchy.reach,
                      steps = static_cast<long double>(a.outline.grid_step) + b.outline.grid_step,
                      most = 1.4e-6L * reach + detail::rounding::outline_grid_steps * steps + 0.9e-6L * exact;
    ASSERT_LE(exact - found.distance[i], most) << i;
    if (found.distance[i] == 0) {
      EXPECT_EQ(found.discs[i], DiscPair::none);
      EXPECT_EQ(found.direction[i], (Vec2{0, 0}));
      EXPECT_EQ(found.points[i], NearestPoints{});
      continue;
    }
    ++apart;
    const auto slack = static_cast<double>(most);
    EXPECT_LE(distance_from_outline(a, scene.crowd.heading[pair.first], found.points[i].first), slack) << i;
    EXPECT_LE(distance_from_outline(b, scene.crowd.heading[pair.second], found.points[i].second), slack) << i;
    const auto [way_x, way_y] = test::way_between(found.points[i], scene.crowd, pair);
    const double x = found.direction[i].x, y = found.direction[i].y, distance = found.distance[i];
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
    expect_in_disc(a, pair.first, found.discs[i].first, found.points[i].first);
    expect_in_disc(b, pair.second, found.discs[i].second, found.points[i].second);
  }
  EXPECT_GT(apart, scene.pairs.size() / 10);
}

TEST(SegmentClearanceOfOutlines, IsTheirDistanceForAnySize) {
  Random random(2702);
  const std::vector<Shape> shapes = test::simple_shapes(random, 400);
  const ShapeSet set(shapes);
  const test::TouchingScene scene = test::touching_scene(random, shapes, test::samples(60'000));
  expect_distances_of_outlines(shapes, scene, find(set, scene));
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
  expect_distances_of_outlines(shapes, scene, find(set, scene));
}

TEST(SegmentClearanceOfOutlines, IsTheirDistanceForPeople) {
  const std::vector<Shape> shapes = test::pose_shapes(default_male(), 12);
  const ShapeSet set(shapes);
  Random random(2704);
  PairScene scene = random_scene(random, set, 2'000);
  scene.crowd.level.clear();
  expect_distances_of_outlines(shapes, scene, find(set, scene));
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
  const Found first = find(set, scene);
  for (const Implementation& implementation : test::supported()) {
    const Found found = find(set, scene, {.implementation = &implementation});
    for (std::size_t i = 0; i < scene.pairs.size(); ++i)
      ASSERT_TRUE(found.same(i, first, i)) << implementation.name << ", pair " << i;
  }
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const auto nearest = reference.nearest(scene.crowd.agents(), scene.pairs[i]);
    ASSERT_EQ(first.distance[i], nearest->distance) << i;
    if (first.distance[i] == 0) continue;
    const auto [a, b] = scene.pairs[i];
    EXPECT_LT(distance_from_segment(shapes[0], nearest->a, scene.crowd.heading[a], first.points[i].first),
              1e-6);
    EXPECT_LT(distance_from_segment(shapes[0], nearest->b, scene.crowd.heading[b], first.points[i].second),
              1e-6);
  }
}

}  // namespace
}  // namespace bch
