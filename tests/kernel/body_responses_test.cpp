// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/body_scenes.hpp"
#include "tests/support/crowd_pairs.hpp"
#include "tests/support/test.hpp"

// Contacts and penetrations of bodies of spheres, and what a crowd of them finds.
namespace bch {
namespace {

using test::BodyCrowd;
using test::PlacedSphere;
using test::Random;

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
  for (const double height : {0.0, 0.005, 0.3, 3.0}) {
    const BodyCrowd crowd = test::random_body_crowd(random, 24, bodies.body_count(), 3, height);
    const auto placed = test::placed_spheres(bodies, crowd);
    const auto hits = hits_of(bodies, crowd.agents(), crowd.pairs);
    Crowd finder;
    for (const auto& pairs : {crowd.pairs, test::exchanged(crowd.pairs)}) {
      const Rows<Crowd::SphereContact> rows = finder.contacts(bodies, crowd.agents(), pairs);
      ASSERT_EQ(rows.size(), pairs.size());
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        ASSERT_EQ(!rows[i].empty(), hits[i] == 1) << "pair " << i;
        ASSERT_TRUE(hits[i] == 1 || test::gap(placed[pairs[i].first], placed[pairs[i].second]) > 0);
        expect_overlaps(rows[i], placed[pairs[i].first], placed[pairs[i].second]);
      }
    }
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
  constexpr std::uint32_t directions = 16;
  for (const double height : {0.5, 4.0}) {  // of which some are above each other
    const BodyCrowd crowd = test::random_body_crowd(random, 40, bodies.body_count(), 3, height);
    const auto placed = test::placed_spheres(bodies, crowd);
    std::vector<Penetration> ways(crowd.pairs.size()), others(ways.size());
    penetration(bodies, crowd.agents(), test::exchanged(crowd.pairs), directions, others);
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

TEST(BodiesOfACrowd, AreAnsweredAsTheirPairs) {
  Random random(5502);
  const BodySet bodies = test::random_bodies(random);
  const BodyCrowd people = test::random_body_crowd(random, 300, bodies.body_count(), 8, 1);
  const Agents agents = people.agents();
  Crowd crowd, of_pairs;
  const auto touching = crowd.collisions(bodies, agents);
  const std::vector<Pair> pairs(touching.begin(), touching.end());
  const auto hits = hits_of(bodies, agents, people.pairs);
  std::vector<Pair> expected;
  for (std::size_t i = 0; i < hits.size(); ++i)
    if (hits[i]) expected.push_back(test::exchanged({&people.pairs[i], 1})[0]);  // the lower number first
  ASSERT_FALSE(expected.empty());
  EXPECT_EQ(test::sorted(pairs), test::sorted(expected));

  const Crowd::BodyContacts found = crowd.contacts(bodies, agents);
  EXPECT_TRUE(std::ranges::equal(found.pairs, pairs));
  for (const Implementation& implementation : test::supported()) {
    const auto rows = of_pairs.contacts(bodies, agents, pairs, &implementation);
    EXPECT_TRUE(std::ranges::equal(found.contacts.offsets, rows.offsets)) << implementation.name;
    EXPECT_TRUE(std::ranges::equal(found.contacts.values, rows.values)) << implementation.name;
  }
  std::vector<Penetration> ways(pairs.size());
  penetration(bodies, agents, pairs, 32, ways);
  const Crowd::Penetrations parted = crowd.penetrations(bodies, agents, 32);
  EXPECT_TRUE(std::ranges::equal(parted.pairs, pairs));
  EXPECT_TRUE(std::ranges::equal(parted.penetrations, ways));
}

TEST(BodiesOfACrowd, FindThoseThatAreNear) {
  Random random(3);
  const BodySet bodies = test::random_bodies(random);
  const BodyCrowd crowd = test::random_body_crowd(random, 200, bodies.body_count(), 8, 4);
  constexpr double limit = 0.5;
  std::vector<float> distance(crowd.pairs.size());
  clearance(bodies, crowd.agents(), crowd.pairs, {distance},
            {.max_distance = limit, .overlap = Overlap::deepest});
  std::map<std::pair<std::uint32_t, std::uint32_t>, float> expected, found;
  for (std::size_t i = 0; i < distance.size(); ++i)
    if (distance[i] <= static_cast<float>(limit))
      expected[std::minmax(crowd.pairs[i].first, crowd.pairs[i].second)] = distance[i];
  Crowd finder;
  const bch::Crowd::BodyClearances near =
      finder.clearances(bodies, crowd.agents(), {.max_distance = limit, .overlap = Overlap::deepest});
  for (std::size_t i = 0; i < near.pairs.size(); ++i)
    found[{near.pairs[i].first, near.pairs[i].second}] = near.distance[i];
  EXPECT_EQ(found, expected);
  const auto placed = test::placed_spheres(bodies, crowd);
  const auto is_above = [&](const auto& each) {
    return each.second > 0 && std::abs(crowd.z[each.first.first] - crowd.z[each.first.second]) > 2;
  };
  EXPECT_TRUE(std::any_of(expected.begin(), expected.end(), is_above)) << "some are near only in height";
  for (std::size_t i = 0; i < near.pairs.size(); ++i) {
    const auto [a, b] = near.pairs[i];
    const auto [p, q] = near.points[i];
    const Vec3 d = near.direction[i];
    const float gap = near.distance[i];
    EXPECT_NEAR(double{gap}, test::gap(placed[a], placed[b]), 2e-5);
    EXPECT_NEAR(crowd.x[a] + double{p.x + gap * d.x}, crowd.x[b] + double{q.x}, 2e-5);
    EXPECT_NEAR(crowd.y[a] + double{p.y + gap * d.y}, crowd.y[b] + double{q.y}, 2e-5);
    EXPECT_NEAR(crowd.z[a] + double{p.z + gap * d.z}, crowd.z[b] + double{q.z}, 2e-5);
    const test::PlacedSphere& sphere = placed[a][near.spheres[i].first];
    EXPECT_NEAR(std::hypot(crowd.x[a] + double{p.x} - sphere.x, crowd.y[a] + double{p.y} - sphere.y,
                           crowd.z[a] + double{p.z} - sphere.z),
                sphere.radius, 2e-5);
  }
}

TEST(Bodies, RefuseWhatIsNoBody) {
  const std::vector<std::vector<Sphere>> none(1), negative{{{0, 0, 0, -1}}},
      not_finite{{{0, 0, 0, 1}, {0, std::nanf(""), 0, 1}}}, a_point{{{0, 0, 0, 0}}};
  EXPECT_THROW(BodySet{none}, std::invalid_argument);
  EXPECT_THROW(BodySet{negative}, std::invalid_argument);
  EXPECT_THROW(BodySet{not_finite}, std::invalid_argument);
  EXPECT_THROW(BodySet{a_point}, std::invalid_argument);
}

}  // namespace
}  // namespace bch
