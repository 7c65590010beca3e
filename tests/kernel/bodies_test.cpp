// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/body_set.hpp>

#include "tests/support/body_scenes.hpp"
#include "tests/support/test.hpp"

namespace bch {
namespace {

using test::BodyCrowd;
using test::Random;

TEST(Bodies, CollideWhereSomeSpheresOverlap) {
  Random random(1);
  const BodySet bodies = test::random_bodies(random);
  for (const double height : {0.0, 0.005, 0.4, 3.0}) {
    const BodyCrowd crowd = test::random_body_crowd(random, 40, bodies.body_count(), 3, height);
    const auto placed = test::placed_spheres(bodies, crowd);
    std::vector<double> gaps;
    for (const auto [a, b] : crowd.pairs) gaps.push_back(test::gap(placed[a], placed[b]));
    EXPECT_LT(*std::min_element(gaps.begin(), gaps.end()), 0);
    EXPECT_GT(*std::max_element(gaps.begin(), gaps.end()), 0);
    std::vector<std::uint8_t> hits(crowd.pairs.size());
    for (const Implementation& implementation : implementations()) {
      if (!implementation.supported()) continue;
      collide(bodies, crowd.agents(), crowd.pairs, hits, &implementation);
      for (std::size_t i = 0; i < hits.size(); ++i)
        EXPECT_TRUE(hits[i] ? gaps[i] < 1e-5 : gaps[i] > 0) << implementation.name << " pair " << i;
    }
  }
}

TEST(Bodies, ACrowdFindsTheirCollisions) {
  Random random(2);
  const BodySet bodies = test::random_bodies(random);
  const BodyCrowd crowd = test::random_body_crowd(random, 200, bodies.body_count(), 6, 1);
  std::vector<std::uint8_t> hits(crowd.pairs.size());
  collide(bodies, crowd.agents(), crowd.pairs, hits);
  std::set<std::pair<std::uint32_t, std::uint32_t>> expected, found;
  for (std::size_t i = 0; i < hits.size(); ++i)
    if (hits[i]) expected.insert(std::minmax(crowd.pairs[i].first, crowd.pairs[i].second));
  Crowd finder;
  for (const auto [a, b] : finder.collisions(bodies, crowd.agents())) found.insert({a, b});
  EXPECT_FALSE(expected.empty());
  EXPECT_EQ(found, expected);
}

TEST(Bodies, ACrowdFindsThoseThatAreNear) {
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
