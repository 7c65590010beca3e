// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/body_reference.hpp"
#include "kernel/runtime/all_options.hpp"
#include "tests/support/body_scenes.hpp"
#include "tests/support/test.hpp"

// Bodies of spheres in every implementation and in the brute-force reference: the same bits.
namespace bch {
namespace {

using test::bodies_of_all_kinds;
using test::BodyCrowd;
using test::Random;

using Hits = std::vector<std::uint8_t>;

/// Holds all answers about the distances of pairs.
struct Distances {
  std::vector<float> distance;
  std::vector<Vec3> direction;
  std::vector<DiscPair> spheres;
  std::vector<BodyClearanceAnswers::Points> points;

  explicit Distances(std::size_t pairs) : distance(pairs), direction(pairs), spheres(pairs), points(pairs) {}
  Distances(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
            const detail::AllOptions& options)
      : Distances(pairs.size()) {
    clearance(bodies, agents, pairs, {distance, direction, spheres, points}, options);
  }
};

/// Holds the reference's answers about pairs.
struct Expected {
  Hits hits;
  std::vector<baselines::BodyClearance> nearest;
  std::vector<double> distances;  ///< those of the pairs, or a little less or more
  Hits within;                    ///< these distances

  Expected(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs) {
    const baselines::BodyReference reference(bodies);
    for (const Pair pair : pairs) {
      hits.push_back(reference.collide(agents, pair));
      nearest.push_back(reference.clearance(agents, pair));
      const double factor[] = {1 - 0x1p-18, 1, 1.1};
      distances.push_back(std::max(0.0, static_cast<double>(nearest.back().distance)) *
                          factor[distances.size() % 3]);
      within.push_back(reference.within(agents, pair, distances.back()));
    }
  }
  void turn() {
    for (baselines::BodyClearance& each : nearest) std::swap(each.first, each.second);
  }
};

/// Expects the reference's distances, and that what goes with them is the same whatever overlaps and limits are asked for.
void expect_distances(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
                      const Expected& expected, const Implementation& implementation) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const Distances deepest(bodies, agents, pairs,
                          {.implementation = &implementation, .overlap = Overlap::deepest});
  const Distances apart(bodies, agents, pairs, {.implementation = &implementation});
  std::vector<float> sorted = apart.distance;
  std::sort(sorted.begin(), sorted.end());
  const float limit = sorted[sorted.size() / 2];
  const Distances limited(bodies, agents, pairs,
                          {.implementation = &implementation, .max_distance = static_cast<double>(limit)});
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const float distance = expected.nearest[i].distance;
    const DiscPair spheres{expected.nearest[i].first, expected.nearest[i].second};
    ASSERT_EQ(deepest.distance[i], distance) << "pair " << i;
    ASSERT_EQ(deepest.spheres[i], spheres) << "pair " << i;
    const bool overlap = distance <= 0, is_near = distance <= limit;
    ASSERT_EQ(overlap, expected.hits[i] == 1) << "pair " << i;
    ASSERT_EQ(apart.distance[i], overlap ? 0 : distance) << "pair " << i;
    ASSERT_EQ(apart.spheres[i], overlap ? DiscPair::none : spheres) << "pair " << i;
    ASSERT_EQ(apart.points[i], overlap ? BodyClearanceAnswers::Points{} : deepest.points[i]) << "pair " << i;
    ASSERT_EQ(apart.direction[i], overlap ? Vec3{} : deepest.direction[i]) << "pair " << i;
    ASSERT_EQ(limited.distance[i], is_near ? apart.distance[i] : infinity) << "pair " << i;
    ASSERT_EQ(limited.spheres[i], is_near ? apart.spheres[i] : DiscPair::none) << "pair " << i;
  }
  Hits near(pairs.size());
  within(bodies, agents, pairs, expected.distances, near, &implementation);
  EXPECT_EQ(near, expected.within);
  for (std::size_t i = 0; i < pairs.size(); ++i)
    ASSERT_TRUE(near[i] == 1 || i % 3 == 0 || expected.hits[i] == 1) << "pair " << i;
}

/// Returns the reference's answers, and expects them of all implementations, and of pairs the other way round.
Hits expect_reference(const BodySet& bodies, const BodyCrowd& crowd, const Agents& agents) {
  Expected expected(bodies, agents, crowd.pairs);
  Hits hits(crowd.pairs.size());
  for (const auto& pairs : {crowd.pairs, test::exchanged(crowd.pairs)}) {
    for (const Implementation& implementation : test::supported()) {
      SCOPED_TRACE(implementation.name);
      std::fill(hits.begin(), hits.end(), std::uint8_t{2});
      collide(bodies, agents, pairs, hits, &implementation);
      const auto at = std::mismatch(hits.begin(), hits.end(), expected.hits.begin()).first - hits.begin();
      if (static_cast<std::size_t>(at) < hits.size())
        ADD_FAILURE() << "pair " << at << ": " << int{hits[static_cast<std::size_t>(at)]};
      expect_distances(bodies, agents, pairs, expected, implementation);
    }
    expected.turn();
  }
  return expected.hits;
}
Hits expect_reference(const BodySet& bodies, const BodyCrowd& crowd) {
  return expect_reference(bodies, crowd, crowd.agents());
}

/// Expects that some pairs collide and others do not.
void expect_both(const Hits& hits) {
  const auto count = std::count(hits.begin(), hits.end(), 1);
  EXPECT_GT(count, 0);
  EXPECT_LT(count, static_cast<std::ptrdiff_t>(hits.size()));
}

/// Half as many agents with sanitizers, which make a quarter of the pairs.
constexpr std::uint32_t crowd_size(std::uint32_t agents) {
  return test::samples(2) == 2 ? agents : agents / 2;
}

TEST(BodyDifferential, CrowdsOnOneGroundAndOnMany) {
  Random random(5401);
  const BodySet bodies = bodies_of_all_kinds(random);
  for (const double height : {0.0, 1e-5, 0.009, 0.0101, 0.17, 0.6, 2.5, 30.0}) {
    SCOPED_TRACE(height);
    expect_both(
        expect_reference(bodies, test::random_body_crowd(random, 60, bodies.body_count(), 4, height)));
  }
}

TEST(BodyDifferential, AgentsWithoutHeights) {
  Random random(5402);
  const BodySet bodies = bodies_of_all_kinds(random);
  const BodyCrowd crowd = test::random_body_crowd(random, 60, bodies.body_count(), 4, 0);
  Agents agents = crowd.agents();
  agents.z = {};
  const Hits hits = expect_reference(bodies, crowd, agents);
  EXPECT_EQ(hits, expect_reference(bodies, crowd));
  expect_both(hits);
}

TEST(BodyDifferential, FarFromTheOrigin) {
  Random random(5403);
  const BodySet bodies = bodies_of_all_kinds(random);
  BodyCrowd crowd = test::random_body_crowd(random, 60, bodies.body_count(), 4, 1);
  for (std::size_t i = 0; i < crowd.x.size(); ++i) crowd.x[i] += 1e7, crowd.y[i] -= 1e7, crowd.z[i] += 1e7;
  expect_both(expect_reference(bodies, crowd));
}

TEST(BodyDifferential, FarFromEachOther) {
  Random random(5404);
  const BodySet bodies = bodies_of_all_kinds(random);
  for (const double side : {1e3, 1e6, 1e9})
    for (const double height : {0.0, side}) {
      const Hits hits = expect_reference(
          bodies, test::random_body_crowd(random, crowd_size(40), bodies.body_count(), side, height));
      EXPECT_EQ(std::count(hits.begin(), hits.end(), 1), 0);
    }
}

TEST(BodyDifferential, EqualPlacesAndAgentsWithThemselves) {
  Random random(5405);
  const BodySet bodies = bodies_of_all_kinds(random);
  BodyCrowd crowd = test::random_body_crowd(random, 40, bodies.body_count(), 0, 0);
  for (std::uint32_t i = 0; i < 40; ++i) crowd.pairs.push_back({i, i});
  const Hits hits = expect_reference(bodies, crowd);
  EXPECT_EQ(std::count(hits.end() - 40, hits.end(), 1), 40);
}

TEST(BodyDifferential, AnyNumberOfSpheres) {
  Random random(5406);
  std::vector<std::vector<Sphere>> all;
  for (std::uint32_t spheres = 1; spheres <= 40; ++spheres) all.push_back(test::random_body(random, spheres));
  for (const std::uint32_t spheres : {383u, 384u, 392u, 393u, 1000u, 4095u, 4096u})
    all.push_back(test::random_body(random, spheres));
  const BodySet bodies(all);
  expect_both(
      expect_reference(bodies, test::random_body_crowd(random, crowd_size(80), bodies.body_count(), 6, 0.3)));
}

TEST(BodyDifferential, BodiesOfAnySize) {
  Random random(5407);
  for (const float scale : {1e-5f, 0.01f, 100.0f, 2e5f}) {
    SCOPED_TRACE(scale);
    const BodySet bodies = bodies_of_all_kinds(random, scale);
    const double side = 4 * static_cast<double>(scale);
    for (const double height : {0.0, 0.1 * side})
      expect_both(expect_reference(
          bodies, test::random_body_crowd(random, crowd_size(40), bodies.body_count(), side, height)));
  }
}

TEST(BodyDifferential, AnySplitOfABatch) {
  Random random(5408);
  const BodySet bodies = bodies_of_all_kinds(random);
  const BodyCrowd crowd = test::random_body_crowd(random, 50, bodies.body_count(), 4, 0.3);
  const Hits expected = expect_reference(bodies, crowd);
  for (const Implementation& implementation : test::supported())
    for (const std::size_t size : {1u, 7u, 16u, 255u, 257u}) {
      Hits hits(expected.size());
      for (std::size_t begin = 0; begin < hits.size(); begin += size) {
        const std::size_t count = std::min(size, hits.size() - begin);
        collide(bodies, crowd.agents(), std::span(crowd.pairs).subspan(begin, count),
                std::span(hits).subspan(begin, count), &implementation);
      }
      EXPECT_EQ(hits, expected) << implementation.name << " in batches of " << size;
    }
}

/// Moves the second agent of each pair to where two spheres touch: along a random line in space, to a few units in the last place of
/// where the answer changes.
void make_tangent(Random& random, const baselines::BodyReference& reference, BodyCrowd& crowd, bool level) {
  for (const Pair pair : crowd.pairs) {
    const double turn = random.between(-4, 4), up = level ? 0 : random.between(-1, 1);
    const double flat = std::sqrt(1 - up * up);
    const auto collides_at = [&](double distance) {
      crowd.x[pair.second] = crowd.x[pair.first] + distance * flat * std::cos(turn);
      crowd.y[pair.second] = crowd.y[pair.first] + distance * flat * std::sin(turn);
      crowd.z[pair.second] = crowd.z[pair.first] + distance * up;
      return reference.collide(crowd.agents(), pair);
    };
    double near = 0, far = 8;
    for (int halving = 0; halving < 48; ++halving) {
      const double middle = (near + far) / 2;
      (collides_at(middle) ? near : far) = middle;
    }
    collides_at(near + random.between(-64, 64) * 0x1p-24 * near);
  }
}

TEST(BodyDifferential, SpheresThatJustTouch) {
  Random random(5409);
  const BodySet bodies = bodies_of_all_kinds(random);
  const baselines::BodyReference reference(bodies);
  constexpr std::uint32_t agents = 2 * test::samples(400);
  for (const bool level : {true, false})
    for (const double away : {0.0, 3.0, 1e5}) {
      BodyCrowd crowd = test::random_body_crowd(random, agents, bodies.body_count(), away, level ? 0 : 1);
      crowd.pairs.clear();
      for (std::uint32_t i = 0; i < agents; i += 2) crowd.pairs.push_back({i, i + 1});
      make_tangent(random, reference, crowd, level);
      expect_both(expect_reference(bodies, crowd));
    }
}

}  // namespace
}  // namespace bch
