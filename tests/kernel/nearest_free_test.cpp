// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/body_scenes.hpp"
#include "tests/support/test.hpp"

// The nearest free place of bodies of spheres.
namespace bch {
namespace {

using test::BodyCrowd;
using test::PlacedSphere;
using test::Random;
using Spheres = std::vector<PlacedSphere>;

constexpr std::uint32_t directions = 16;

std::vector<Penetration> ways_of(const BodySet& bodies, const BodyCrowd& crowd, std::span<const Pair> pairs,
                                 const Implementation* implementation = nullptr) {
  std::vector<Penetration> ways(pairs.size());
  nearest_free(bodies, crowd.agents(), pairs, directions, ways, implementation);
  return ways;
}

std::vector<std::uint8_t> hits_of(const BodySet& bodies, const BodyCrowd& crowd) {
  std::vector<std::uint8_t> hits(crowd.pairs.size());
  collide(bodies, crowd.agents(), crowd.pairs, hits);
  return hits;
}

/// Returns the first place along a direction at which spheres, grown by so much, do not overlap: all intervals are sorted.
double free_place(const Spheres& a, const Spheres& b, double x, double y, double grown) {
  std::vector<std::pair<double, double>> taken;
  for (const PlacedSphere& p : a)
    for (const PlacedSphere& q : b) {
      const double dx = q.x - p.x, dy = q.y - p.y, dz = q.z - p.z, radius = p.radius + q.radius + grown;
      const double middle = dx * x + dy * y, across = dx * y - dy * x;
      const double half = radius * radius - across * across - dz * dz;
      if (half > 0) taken.push_back({middle - std::sqrt(half), middle + std::sqrt(half)});
    }
  std::ranges::sort(taken);
  double place = 0;
  for (const auto& [low, high] : taken)
    if (low < place) place = std::max(place, high);
  return place;
}

double least_way(const Spheres& a, const Spheres& b, double grown) {
  double least = 1e300;
  for (std::uint32_t k = 0; k < directions; ++k) {
    const double angle = 2 * std::numbers::pi * k / directions;
    least = std::min(least, free_place(a, b, std::cos(angle), std::sin(angle), grown));
  }
  return least;
}

/// People who stand close, at several heights.
struct CloseCrowd {
  Random random{5601};
  BodySet bodies = test::random_bodies(random);
  BodyCrowd crowd = test::random_body_crowd(random, 40, bodies.body_count(), 2.5, 0.4);
};

TEST(NearestFree, IsTheLeastWayOutOfAllSpheres) {
  const CloseCrowd scene;
  const auto placed = test::placed_spheres(scene.bodies, scene.crowd);
  const auto hits = hits_of(scene.bodies, scene.crowd);
  const auto ways = ways_of(scene.bodies, scene.crowd, scene.crowd.pairs);
  std::vector<Penetration> whole(ways.size());
  penetration(scene.bodies, scene.crowd.agents(), scene.crowd.pairs, directions, whole);
  double shorter = 0, longer = 0;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const auto [depth, x, y] = ways[i];
    if (hits[i] == 0) {
      ASSERT_EQ(depth, 0.0f);
      continue;
    }
    const Spheres &a = placed[scene.crowd.pairs[i].first], &b = placed[scene.crowd.pairs[i].second];
    ASSERT_NEAR(std::hypot(x, y), 1, 1e-9);
    ASSERT_GE(double{depth}, free_place(a, b, x, y, 0)) << i;
    ASSERT_GE(double{depth}, least_way(a, b, 0)) << i;
    ASSERT_LE(double{depth}, least_way(a, b, 3e-5)) << i;
    ASSERT_LE(double{depth}, double{whole[i].depth} + 3e-5) << i;
    shorter += double{depth}, longer += double{whole[i].depth};
  }
  EXPECT_GT(shorter, 0);
  EXPECT_LT(shorter, 0.8 * longer) << "bodies may stay entangled";
}

TEST(NearestFree, LeavesNoCollision) {
  const CloseCrowd scene;
  const auto ways = ways_of(scene.bodies, scene.crowd, scene.crowd.pairs);
  for (std::size_t i = 0; i < ways.size(); ++i) {
    BodyCrowd moved = scene.crowd;
    const std::uint32_t first = moved.pairs[i].first;
    moved.pairs = {scene.crowd.pairs[i]};
    moved.x[first] += double{ways[i].depth} * ways[i].x, moved.y[first] += double{ways[i].depth} * ways[i].y;
    ASSERT_EQ(hits_of(scene.bodies, moved)[0], 0) << i;
  }
}

using Touches = std::vector<Penetration::Touch>;

Touches touches_of(const CloseCrowd& scene, std::span<const Pair> pairs,
                   const Implementation* implementation = nullptr) {
  std::vector<Penetration> ways(pairs.size());
  Touches touches(pairs.size());
  nearest_free(scene.bodies, scene.crowd.agents(), pairs, directions, ways, implementation, touches);
  EXPECT_EQ(ways, ways_of(scene.bodies, scene.crowd, pairs));
  return touches;
}

/// How far a touch is from that of two spheres, the first of which has moved along a way.
double difference(const Penetration::Touch& touch, const PlacedSphere& a, const PlacedSphere& b,
                  const Penetration& way) {
  const double x = a.x + double{way.depth} * way.x - b.x, y = a.y + double{way.depth} * way.y - b.y,
               z = a.z - b.z, length = std::hypot(x, y, z);
  const double px = a.x - a.agent_x - a.radius * x / length, py = a.y - a.agent_y - a.radius * y / length,
               pz = a.z - a.agent_z - a.radius * z / length;
  return std::max(
      {std::abs(length - a.radius - b.radius),
       std::hypot(px - double{touch.point.x}, py - double{touch.point.y}, pz - double{touch.point.z}),
       std::hypot(x / length - double{touch.normal.x}, y / length - double{touch.normal.y},
                  z / length - double{touch.normal.z})});
}

TEST(NearestFree, EndsWhereTwoSpheresTouch) {
  const CloseCrowd scene;
  const auto placed = test::placed_spheres(scene.bodies, scene.crowd);
  const auto ways = ways_of(scene.bodies, scene.crowd, scene.crowd.pairs);
  const Touches touches = touches_of(scene, scene.crowd.pairs);
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const auto [first, second] = scene.crowd.pairs[i];
    if (ways[i].depth == 0) {
      ASSERT_EQ(touches[i], (Penetration::Touch{{0, 0, 0}, {0, 0, 0}}));
      continue;
    }
    double least = 1;
    for (const PlacedSphere& a : placed[first])
      for (const PlacedSphere& b : placed[second])
        least = std::min(least, difference(touches[i], a, b, ways[i]));
    ASSERT_LT(least, 1e-4) << i;
    const Vec3 normal = touches[i].normal;
    ASSERT_GT(double{normal.x} * ways[i].x + double{normal.y} * ways[i].y, 0) << i;
  }
}

TEST(NearestFree, TouchesAtTheSamePointFromEitherSide) {
  const CloseCrowd scene;
  const auto ways = ways_of(scene.bodies, scene.crowd, scene.crowd.pairs);
  const Touches touches = touches_of(scene, scene.crowd.pairs);
  std::vector<Pair> turned;
  for (const Pair pair : scene.crowd.pairs) turned.push_back({pair.second, pair.first});
  for (const Implementation& implementation : test::supported()) {
    EXPECT_EQ(touches_of(scene, scene.crowd.pairs, &implementation), touches) << implementation.name;
    const Touches others = touches_of(scene, turned, &implementation);
    for (std::size_t i = 0; i < ways.size(); ++i) {
      const auto& [point, normal] = touches[i];
      ASSERT_EQ(others[i].normal, (Vec3{-normal.x, -normal.y, -normal.z})) << i;
      if (ways[i].depth == 0) continue;
      const auto [a, b] = scene.crowd.pairs[i];
      const double depth{ways[i].depth};
      const auto& [x, y, z] = others[i].point;
      ASSERT_NEAR(scene.crowd.x[a] + depth * ways[i].x + double{point.x}, scene.crowd.x[b] + double{x}, 1e-6);
      ASSERT_NEAR(scene.crowd.y[a] + depth * ways[i].y + double{point.y}, scene.crowd.y[b] + double{y}, 1e-6);
      ASSERT_NEAR(scene.crowd.z[a] + double{point.z}, scene.crowd.z[b] + double{z}, 1e-6);
    }
  }
}

TEST(NearestFree, IsTheSameOnEveryImplementationAndFromEitherSide) {
  const CloseCrowd scene;
  const auto ways = ways_of(scene.bodies, scene.crowd, scene.crowd.pairs);
  std::vector<Pair> turned;
  for (const Pair pair : scene.crowd.pairs) turned.push_back({pair.second, pair.first});
  for (const Implementation& implementation : test::supported()) {
    EXPECT_TRUE(
        std::ranges::equal(ways_of(scene.bodies, scene.crowd, scene.crowd.pairs, &implementation), ways));
    const auto others = ways_of(scene.bodies, scene.crowd, turned, &implementation);
    for (std::size_t i = 0; i < ways.size(); ++i)
      ASSERT_EQ(others[i], (Penetration{ways[i].depth, -ways[i].x, -ways[i].y})) << i;
  }
}

TEST(NearestFree, RefusesWhatIsInvalid) {
  const CloseCrowd scene;
  std::vector<Penetration> ways(1);
  const auto said = [&](std::span<const Pair> pairs, std::uint32_t number) {
    return test::complaint([&] { nearest_free(scene.bodies, scene.crowd.agents(), pairs, number, ways); });
  };
  const std::vector<Pair> one = {{0, 1}}, two = {{0, 1}, {0, 2}}, nobody = {{0, 99}};
  EXPECT_EQ(said(one, 16), "accepted");
  EXPECT_EQ(said(one, 3), "nearest_free: expected an even number of directions from 2 to 256, found 3");
  EXPECT_EQ(said(two, 16), "nearest_free: expected 2 answers, one per pair, found 1");
  Touches touches(2);
  EXPECT_EQ(test::complaint(
                [&] { nearest_free(scene.bodies, scene.crowd.agents(), one, 16, ways, nullptr, touches); }),
            "nearest_free: expected 1 touches, one per pair, found 2");
  EXPECT_TRUE(test::has(said(nobody, 16), "99"));
}

}  // namespace
}  // namespace bch
