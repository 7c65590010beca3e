// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/differential.hpp"
#include "tests/support/implementations.hpp"
#include "tests/support/test.hpp"

// The nearest free place of outlines.
namespace bch {
namespace {

using test::PairScene;
using test::Random;
using Ways = std::vector<Penetration>;

constexpr std::uint32_t directions = 16;

Ways ways_of(const ShapeSet& set, const PairScene& scene, const CollideOptions& options = {}) {
  Ways ways(scene.pairs.size());
  nearest_free(set, scene.crowd.agents(), scene.pairs, directions, ways, options);
  return ways;
}

std::vector<Penetration::Touch> touches_of(const ShapeSet& set, const PairScene& scene,
                                           const CollideOptions& options = {}) {
  Ways ways(scene.pairs.size());
  std::vector<Penetration::Touch> touches(scene.pairs.size());
  nearest_free(set, scene.crowd.agents(), scene.pairs, directions, ways, options, touches);
  return touches;
}

std::vector<std::uint8_t> hits_of(const ShapeSet& set, const PairScene& scene,
                                  const CollideOptions& options = {}) {
  std::vector<std::uint8_t> hits(scene.pairs.size());
  collide(set, scene.crowd.agents(), scene.pairs, hits, options);
  return hits;
}

/// The scene after the first agent of every pair has moved by a share of its way, along it or along another direction.
PairScene part_of_the_way(PairScene scene, const Ways& by, double share, double turned = 0) {
  for (std::size_t i = 0; i < by.size(); ++i) {
    const double way = share * double{by[i].depth}, x = by[i].x, y = by[i].y;
    scene.crowd.x[scene.pairs[i].first] += way * (std::cos(turned) * x - std::sin(turned) * y);
    scene.crowd.y[scene.pairs[i].first] += way * (std::sin(turned) * x + std::cos(turned) * y);
  }
  return scene;
}

class NearestFreeOutlines : public test::Differential {
 protected:
  NearestFreeOutlines() : Differential(5701, {{0, 3, all_depths}}) {}

  double max_extents(const PairScene& scene, Pair pair) const {
    const auto of = [&](std::uint32_t agent) {
      return double{shapes[scene.crowd.shape[agent]].hierarchy.max_extent};
    };
    return of(pair.first) + of(pair.second);
  }
};

TEST_F(NearestFreeOutlines, LeavesNoCollision) {
  for (const bool tangent : {false, true})
    for (const Leaves leaves : {Leaves::segments, Leaves::discs}) {
      const CollideOptions options{nullptr, leaves};
      const PairScene scene = tangent ? tangent_scene(5'000) : random_scene(random, set, 5'000);
      const auto hits = hits_of(set, scene, options);
      const Ways ways = ways_of(set, scene, options);
      Ways whole(ways.size());
      penetration(set, scene.crowd.agents(), scene.pairs, directions, whole);
      const auto after = hits_of(set, part_of_the_way(scene, ways, 1), options);
      std::size_t shorter = 0, collisions = 0;
      for (std::size_t i = 0; i < ways.size(); ++i) {
        ASSERT_EQ(after[i], 0) << i;
        ASSERT_EQ(ways[i].depth > 0, hits[i] != 0) << i;
        ASSERT_NEAR(std::hypot(ways[i].x, ways[i].y), 1, 1e-9);
        if (hits[i] == 0) continue;
        ASSERT_LE(double{ways[i].depth}, double{whole[i].depth} + 2e-5 * max_extents(scene, scene.pairs[i]))
            << i;
        ++collisions;
        if (double{ways[i].depth} < 0.9 * double{whole[i].depth}) ++shorter;
      }
      EXPECT_GT(collisions, ways.size() / 5);
      if (!tangent) {
        EXPECT_GT(shorter, collisions / 20);
      }
    }
}

/// Stars as large as people, none of which fits into another.
struct Stars {
  Random random{5702};
  std::vector<Shape> shapes;
  std::optional<ShapeSet> set;

  Stars() {
    for (std::uint32_t corners = 5; corners < 25; ++corners)
      shapes.push_back(test::contour_shape(test::star(random, 2 * corners, 0.08, 0.4)));
    set.emplace(shapes, ShapeSetPlan{});
  }
};

TEST(NearestFreeStars, NoDirectionHasANearerFreePlace) {
  Stars stars;
  for (int i = 0; i < 5; ++i)  // into which others fit
    stars.shapes.push_back(test::contour_shape(test::star(stars.random, 30, 0.8, 1.2)));
  stars.set.emplace(stars.shapes, ShapeSetPlan{});
  for (const Leaves leaves : {Leaves::segments, Leaves::discs}) {
    // Where discs are tested, leaves may overlap although nodes above them do not.
    const double stays = leaves == Leaves::segments ? 0 : 0.01;
    const CollideOptions options{nullptr, leaves};
    const PairScene scene = random_scene(stars.random, *stars.set, 400);
    const Ways ways = ways_of(*stars.set, scene, options);
    std::size_t places = 0, free = 0;
    for (std::uint32_t k = 0; k < directions; ++k)
      for (double share = 0.01; share < 1; share += 0.01) {
        const auto hits = hits_of(
            *stars.set, part_of_the_way(scene, ways, share, 2 * std::numbers::pi * k / directions), options);
        for (std::size_t i = 0; i < hits.size(); ++i)
          if ((1 - share) * double{ways[i].depth} > 2e-5) ++places, free += hits[i] == 0;
      }
    EXPECT_GT(places, 100'000u);
    EXPECT_LE(static_cast<double>(free), stays * static_cast<double>(places));
  }
}

TEST(NearestFreeStars, GrowsFromTheFirstTouchOn) {
  Stars stars;
  PairScene scene = random_scene(stars.random, *stars.set, 2'000);
  const Ways ways = ways_of(*stars.set, scene);
  scene = part_of_the_way(scene, ways, 1);
  for (const double inside : {1e-4, 1e-3}) {
    PairScene back = scene;
    for (std::size_t i = 0; i < ways.size(); ++i) {
      if (ways[i].depth == 0) continue;
      back.crowd.x[scene.pairs[i].first] -= inside * ways[i].x;
      back.crowd.y[scene.pairs[i].first] -= inside * ways[i].y;
    }
    const Ways again = ways_of(*stars.set, back);
    for (std::size_t i = 0; i < again.size(); ++i)
      ASSERT_LE(double{again[i].depth}, inside + 2e-5) << i << ", of " << ways[i].depth;
  }
}

/// How far a point is from an outline that stands at a place.
double distance_to(const Outline& outline, double turned, double px, double py) {
  const double c = std::cos(turned), s = std::sin(turned), x = c * px + s * py, y = c * py - s * px;
  double least = 1e300;
  for (std::size_t k = 0; k < outline.contours(); ++k) {
    const std::span<const Vec2> points = outline.contour(k);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto [ax, ay] = points[i];
      const auto [bx, by] = points[(i + 1) % points.size()];
      const double dx = double{bx} - double{ax}, dy = double{by} - double{ay}, to_x = x - double{ax},
                   to_y = y - double{ay};
      const double share = std::clamp((to_x * dx + to_y * dy) / (dx * dx + dy * dy), 0.0, 1.0);
      least = std::min(least, std::hypot(to_x - share * dx, to_y - share * dy));
    }
  }
  return least;
}

TEST(NearestFreeStars, EndsWhereTheOutlinesTouch) {
  Stars stars;
  const PairScene scene = random_scene(stars.random, *stars.set, 2'000);
  const auto& shape = scene.crowd.shape;
  const auto &x = scene.crowd.x, &y = scene.crowd.y, &heading = scene.crowd.heading;
  const Ways ways = ways_of(*stars.set, scene);
  const auto touches = touches_of(*stars.set, scene);
  PairScene turned = scene;
  for (Pair& pair : turned.pairs) std::swap(pair.first, pair.second);
  const auto turned_touches = touches_of(*stars.set, turned);
  PairScene back = part_of_the_way(scene, ways, 1);
  std::size_t touching = 0;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const auto& [point, normal] = touches[i];
    ASSERT_EQ(turned_touches[i].normal, (Vec3{-normal.x, -normal.y, -normal.z})) << i;
    if (ways[i].depth == 0) {
      ASSERT_EQ(touches[i], (Penetration::Touch{{0, 0, 0}, {0, 0, 0}}));
      continue;
    }
    ++touching;
    const auto [a, b] = scene.pairs[i];
    const double nx{normal.x}, ny{normal.y};
    ASSERT_NEAR(std::hypot(nx, ny), 1, 1e-6);
    ASSERT_GE(nx * ways[i].x + ny * ways[i].y, -1e-6) << i;
    // The point is on both outlines.
    const Vec3 other = turned_touches[i].point;
    ASSERT_EQ(point.z, 0.0f);
    ASSERT_LT(distance_to(stars.shapes[shape[a]].outline, heading[a], double{point.x}, double{point.y}), 3e-5)
        << i;
    ASSERT_LT(distance_to(stars.shapes[shape[b]].outline, heading[b], double{other.x}, double{other.y}), 3e-5)
        << i;
    ASSERT_NEAR(back.crowd.x[a] + double{point.x}, x[b] + double{other.x}, 1e-6);
    ASSERT_NEAR(back.crowd.y[a] + double{point.y}, y[b] + double{other.y}, 1e-6);
    back.crowd.x[a] -= 2e-4 * nx, back.crowd.y[a] -= 2e-4 * ny;
  }
  const auto hits = hits_of(*stars.set, back);
  const auto against_normals = static_cast<std::size_t>(std::ranges::count(hits, 1));
  EXPECT_GT(touching, 400u);
  EXPECT_GE(static_cast<double>(against_normals), 0.99 * static_cast<double>(touching));
}

TEST(NearestFreeStars, StandsOutsideOfWhatHoldsIt) {
  const Shape small = test::contour_shape(
                  test::polygon({{-0.1f, -0.1f}, {0.1f, -0.1f}, {0.1f, 0.1f}, {-0.1f, 0.1f}})),
              large = test::contour_shape(test::polygon({{-2, -1}, {2, -1}, {2, 1}, {-2, 1}}));
  for (const bool culling : {true, false}) {
    ShapeSetPlan plan;
    plan.culling = culling;
    const ShapeSet set(std::vector<Shape>{small, large}, plan);
    PairScene scene;
    scene.crowd.add({0, 0.3, 0.75, 0, 0}), scene.crowd.add({1, 0, 0, 0, 0});
    scene.pairs = {{0, 1}, {1, 0}};
    const Ways ways = ways_of(set, scene);
    EXPECT_NEAR(double{ways[0].depth}, 0.35, 1e-4);
    EXPECT_NEAR(ways[0].y, 1, 1e-9);
    EXPECT_EQ(ways[1], (Penetration{ways[0].depth, -ways[0].x, -ways[0].y}));
    const auto touches = touches_of(set, scene);
    EXPECT_NEAR(double{touches[0].normal.y}, 1, 1e-6);
    EXPECT_NEAR(double{touches[0].point.y}, -0.1, 1e-5);
    EXPECT_NEAR(std::abs(double{touches[0].point.x}), 0.1, 1e-5) << "a corner of the small one";
  }
}

TEST(NearestFreeStars, KnowsHeightsAndDirections) {
  Stars stars;
  for (Shape& shape : stars.shapes) shape.heights = {0, 1};
  ShapeSetPlan plan;
  plan.heights = true;
  const ShapeSet set(stars.shapes, plan);
  PairScene scene = random_scene(stars.random, set, 400);
  const Ways level = ways_of(set, scene);
  for (std::size_t i = 0; i < scene.crowd.x.size(); ++i)
    scene.crowd.z.push_back(i % 2 == 0 ? 0 : i % 4 == 1 ? 0.5 : 5);
  const Ways raised = ways_of(set, scene);
  for (std::size_t i = 0; i < level.size(); ++i)
    EXPECT_EQ(raised[i], i % 2 == 0 ? level[i] : (Penetration{0, raised[i].x, raised[i].y})) << i;

  std::vector<double> x, y;
  for (const double heading : scene.crowd.heading)
    x.push_back(std::cos(heading)), y.push_back(std::sin(heading));
  Agents agents = scene.crowd.agents();
  agents.heading = Headings(x, y);
  Ways turned(raised.size());
  nearest_free(set, agents, scene.pairs, directions, turned);
  for (std::size_t i = 0; i < turned.size(); ++i)
    EXPECT_NEAR(double{turned[i].depth}, double{raised[i].depth}, 1e-5) << i;
}

TEST_F(NearestFreeOutlines, IsTheSameOnEveryImplementationAndFromEitherSide) {
  PairScene scene = random_scene(random, set, 2'000);
  for (const Leaves leaves : {Leaves::segments, Leaves::discs}) {
    const Ways ways = ways_of(set, scene, {nullptr, leaves});
    const auto touches = touches_of(set, scene, {nullptr, leaves});
    for (std::size_t i = 0; i < ways.size(); ++i)
      ASSERT_NEAR(std::hypot(touches[i].normal.x, touches[i].normal.y), ways[i].depth > 0 ? 1 : 0, 1e-6) << i;
    PairScene turned = scene;
    for (Pair& pair : turned.pairs) std::swap(pair.first, pair.second);
    for (const Implementation& implementation : test::supported()) {
      EXPECT_EQ(ways_of(set, scene, {&implementation, leaves}), ways) << implementation.name;
      EXPECT_EQ(touches_of(set, scene, {&implementation, leaves}), touches) << implementation.name;
      const Ways others = ways_of(set, turned, {&implementation, leaves});
      for (std::size_t i = 0; i < ways.size(); ++i)
        ASSERT_EQ(others[i], (Penetration{ways[i].depth, -ways[i].x, -ways[i].y})) << i;
    }
  }
}

TEST_F(NearestFreeOutlines, RefusesWhatIsInvalid) {
  const PairScene scene = random_scene(random, set, 2);
  Ways ways(1);
  const auto said = [&](std::uint32_t number, int leaves) {
    return test::complaint([&] {
      nearest_free(set, scene.crowd.agents(), std::span(scene.pairs).first(1), number, ways,
                   {nullptr, static_cast<Leaves>(leaves)});
    });
  };
  EXPECT_EQ(said(16, 1), "accepted");
  EXPECT_EQ(said(3, 1), "nearest_free: expected an even number of directions from 2 to 256, found 3");
  EXPECT_TRUE(test::has(said(16, 7), "nearest_free: expected leaves of 0 (discs) or 1 (segments), found 7"))
      << said(16, 7);
  ways.resize(2);
  EXPECT_EQ(said(16, 1), "nearest_free: expected 1 answers, one per pair, found 2");
}

}  // namespace
}  // namespace bch
