// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/crowd.hpp>
#include <bch/pairs.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "tests/support/body_scenes.hpp"
#include "tests/support/implementations.hpp"
#include "tests/support/test.hpp"

// Contacts and penetrations of bodies of spheres.
namespace bch {
namespace {

using test::BodyCrowd;
using test::PlacedSphere;
using test::Random;

std::vector<Pair> turned(std::span<const Pair> pairs) {
  std::vector<Pair> all;
  for (const Pair pair : pairs) all.push_back({pair.second, pair.first});
  return all;
}

std::vector<std::uint8_t> hits_of(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs) {
  std::vector<std::uint8_t> hits(pairs.size());
  collide(bodies, agents, pairs, hits);
  return hits;
}

/// Expects the contacts of a pair to be the spheres that overlap, in order.
void expect_overlaps(std::span<const Crowd::SphereContact> contacts, const std::vector<PlacedSphere>& a,
                     const std::vector<PlacedSphere>& b) {
  constexpr double rounding = 2e-5;
  std::size_t next = 0;
  for (std::uint32_t i = 0; i < a.size(); ++i)
    for (std::uint32_t j = 0; j < b.size(); ++j) {
      const double gap = test::gap(a[i], b[j]);
      const bool is_listed = next < contacts.size() && contacts[next].spheres == DiscPair{i, j};
      ASSERT_TRUE(is_listed ? gap < rounding : gap > -rounding) << i << " and " << j << ": " << gap;
      if (!is_listed) continue;
      const auto& [spheres, point, normal, depth] = contacts[next++];
      ASSERT_NEAR(double{depth}, -gap, rounding);
      const double nx = double{normal.x}, ny = double{normal.y}, nz = double{normal.z};
      ASSERT_NEAR(std::hypot(nx, ny, nz), 1, 1e-6);
      const double way = nx * (b[j].x - a[i].x) + ny * (b[j].y - a[i].y) + nz * (b[j].z - a[i].z);
      ASSERT_NEAR(way - a[i].radius - b[j].radius, gap, rounding) << "the normal leads to the other centre";
      ASSERT_NEAR(a[i].agent_x + double{point.x}, a[i].x + nx * a[i].radius, rounding);
      ASSERT_NEAR(a[i].agent_y + double{point.y}, a[i].y + ny * a[i].radius, rounding);
      ASSERT_NEAR(a[i].agent_z + double{point.z}, a[i].z + nz * a[i].radius, rounding);
    }
  ASSERT_EQ(next, contacts.size()) << "each once, in order";
}

TEST(BodyContacts, AreTheSpheresThatOverlap) {
  Random random(5501);
  const BodySet bodies = test::random_bodies(random);
  for (const double height : {0.0, 0.3}) {
    const BodyCrowd crowd = test::random_body_crowd(random, 24, bodies.body_count(), 3, height);
    const auto placed = test::placed_spheres(bodies, crowd);
    const auto hits = hits_of(bodies, crowd.agents(), crowd.pairs);
    Crowd finder;
    for (const auto& pairs : {crowd.pairs, turned(crowd.pairs)}) {
      const Rows<Crowd::SphereContact> rows = finder.contacts(bodies, crowd.agents(), pairs);
      ASSERT_EQ(rows.size(), pairs.size());
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        ASSERT_EQ(!rows[i].empty(), hits[i] == 1) << "pair " << i;
        expect_overlaps(rows[i], placed[pairs[i].first], placed[pairs[i].second]);
      }
    }
  }
}

TEST(BodyContacts, OfACrowdAreThoseOfItsPairs) {
  Random random(5502);
  const BodySet bodies = test::random_bodies(random);
  const BodyCrowd people = test::random_body_crowd(random, 400, bodies.body_count(), 9, 1);
  Crowd crowd, of_pairs;
  const auto touching = crowd.collisions(bodies, people.agents());
  const std::vector<Pair> expected(touching.begin(), touching.end());
  const Crowd::BodyContacts found = crowd.contacts(bodies, people.agents());
  ASSERT_FALSE(expected.empty());
  EXPECT_TRUE(std::equal(found.pairs.begin(), found.pairs.end(), expected.begin(), expected.end()));
  for (const Implementation& implementation : test::supported()) {
    const auto rows = of_pairs.contacts(bodies, people.agents(), expected, &implementation);
    EXPECT_TRUE(std::ranges::equal(found.contacts.offsets, rows.offsets)) << implementation.name;
    EXPECT_TRUE(std::ranges::equal(found.contacts.values, rows.values)) << implementation.name;
  }
}

TEST(BodyContacts, OfGivenPairsHaveNoPeriod) {
  Crowd crowd({.period = {.x = 20}});
  Random random(5503);
  const BodySet bodies = test::random_bodies(random);
  EXPECT_THROW(crowd.contacts(bodies, Agents{}, std::span<const Pair>{}), std::invalid_argument);
}

/// Returns how far spheres of A have to move along a direction until a line separates them from those of B; 0 where heights do not meet.
double way_out(const std::vector<PlacedSphere>& a, const std::vector<PlacedSphere>& b, double x, double y) {
  const auto bottom = [](const auto& of) {
    double least = 1e300;
    for (const PlacedSphere& s : of) least = std::min(least, s.z - s.radius);
    return least;
  };
  const auto top = [](const auto& of) {
    double most = -1e300;
    for (const PlacedSphere& s : of) most = std::max(most, s.z + s.radius);
    return most;
  };
  if (bottom(a) > top(b) || bottom(b) > top(a)) return 0;
  double most = -1e300, least = 1e300;
  for (const PlacedSphere& s : b) most = std::max(most, x * s.x + y * s.y + s.radius);
  for (const PlacedSphere& s : a) least = std::min(least, x * s.x + y * s.y - s.radius);
  return std::max(0.0, most - least);
}

/// Moves the first agent of a pair by its penetration, and returns whether the bodies still collide.
bool collide_after(const BodySet& bodies, BodyCrowd crowd, Pair pair, const Penetration& way) {
  crowd.x[pair.first] += double{way.depth} * way.x, crowd.y[pair.first] += double{way.depth} * way.y;
  return hits_of(bodies, crowd.agents(), {&pair, 1})[0] == 1;
}

TEST(BodyPenetration, IsTheLeastWayToWhereALineSeparates) {
  Random random(5504);
  const BodySet bodies = test::random_bodies(random);
  const BodyCrowd crowd = test::random_body_crowd(random, 40, bodies.body_count(), 3, 0.5);
  const auto placed = test::placed_spheres(bodies, crowd);
  constexpr std::uint32_t directions = 16;
  std::vector<Penetration> ways(crowd.pairs.size()), others(ways.size());
  penetration(bodies, crowd.agents(), turned(crowd.pairs), directions, others);
  for (const Implementation& implementation : test::supported()) {
    penetration(bodies, crowd.agents(), crowd.pairs, directions, ways, &implementation);
    for (std::size_t i = 0; i < ways.size(); ++i) {
      const auto [first, second] = crowd.pairs[i];
      double least = 1e300;
      for (std::uint32_t k = 0; k < directions; ++k) {
        const double angle = 2 * std::numbers::pi * k / directions;
        least = std::min(least, way_out(placed[first], placed[second], std::cos(angle), std::sin(angle)));
      }
      ASSERT_NEAR(double{ways[i].depth}, least, 3e-5) << "pair " << i;
      ASSERT_EQ(others[i], (Penetration{ways[i].depth, -ways[i].x, -ways[i].y})) << "pair " << i;
      ASSERT_FALSE(collide_after(bodies, crowd, crowd.pairs[i], ways[i])) << "pair " << i;
    }
  }
}

TEST(BodyPenetration, AlongADirectionIsThatWay) {
  Random random(5505);
  const BodySet bodies = test::random_bodies(random);
  const BodyCrowd crowd = test::random_body_crowd(random, 40, bodies.body_count(), 3, 0);
  const auto placed = test::placed_spheres(bodies, crowd);
  std::vector<Vec2> directions;
  for (std::size_t i = 0; i < crowd.pairs.size(); ++i) {
    const double angle = random.between(-4, 4);
    directions.push_back({static_cast<float>(3 * std::cos(angle)), static_cast<float>(3 * std::sin(angle))});
  }
  std::vector<Penetration> ways(crowd.pairs.size());
  penetration_along(bodies, crowd.agents(), crowd.pairs, directions, ways);
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const auto [first, second] = crowd.pairs[i];
    ASSERT_NEAR(ways[i].x * double{directions[i].x} + ways[i].y * double{directions[i].y}, 3, 1e-5);
    ASSERT_NEAR(double{ways[i].depth}, way_out(placed[first], placed[second], ways[i].x, ways[i].y), 3e-5);
    ASSERT_FALSE(collide_after(bodies, crowd, crowd.pairs[i], ways[i])) << "pair " << i;
  }
}

TEST(BodyPenetration, OfBodiesAboveEachOtherIsNone) {
  const std::vector<std::vector<Sphere>> ball{{{0, 0, 0.5f, 0.5f}}};
  const BodySet bodies(ball);
  const std::vector<std::uint32_t> body{0, 0};
  const std::vector<double> x{0, 0.2}, y{0, 0}, heading{0, 1};
  const std::vector<Pair> pair{{0, 1}};
  Penetration way{};
  for (const double z : {0.0, 0.9, 1.1}) {
    const std::vector<double> grounds{0, z};
    penetration(bodies, {body, x, y, heading, {}, grounds}, pair, 16, {&way, 1});
    EXPECT_NEAR(double{way.depth}, z > 1 ? 0 : 0.8, 1e-5) << z;
  }
}

TEST(BodyPenetration, OfACrowdIsThatOfItsPairs) {
  Random random(5506);
  const BodySet bodies = test::random_bodies(random);
  const BodyCrowd people = test::random_body_crowd(random, 300, bodies.body_count(), 8, 1);
  Crowd crowd;
  const auto touching = crowd.collisions(bodies, people.agents());
  const std::vector<Pair> pairs(touching.begin(), touching.end());
  std::vector<Penetration> expected(pairs.size());
  penetration(bodies, people.agents(), pairs, 32, expected);
  const Crowd::Penetrations found = crowd.penetrations(bodies, people.agents(), 32);
  EXPECT_TRUE(std::equal(found.pairs.begin(), found.pairs.end(), pairs.begin(), pairs.end()));
  EXPECT_TRUE(std::ranges::equal(found.penetrations, expected));
}

}  // namespace
}  // namespace bch
