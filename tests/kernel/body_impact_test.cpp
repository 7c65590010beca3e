// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/body_reference.hpp"
#include "tests/support/body_scenes.hpp"
#include "tests/support/test.hpp"

// Times of impact of bodies of spheres: the brute-force reference's, never late, and not much too early.
namespace bch {
namespace {

using test::bodies_of_all_kinds;
using test::BodyCrowd;
using test::Random;

constexpr float never_met = std::numeric_limits<float>::infinity();

/// Holds a way of each pair's first agent.
struct SpaceWays {
  std::vector<double> x, y, z;

  /// Makes ways of any direction, most of them towards the second agent and about as long as it is far, some of them level or none.
  SpaceWays(Random& random, const BodyCrowd& crowd, double aside) {
    for (const auto [a, b] : crowd.pairs) {
      const double far = random.between(-0.2, 2);
      const double rise = crowd.z[b] - crowd.z[a];
      const bool is_level = random.below(4) == 0, is_none = random.below(20) == 0;
      x.push_back(is_none ? 0 : far * (crowd.x[b] - crowd.x[a]) + random.between(-aside, aside));
      y.push_back(is_none ? 0 : far * (crowd.y[b] - crowd.y[a]) + random.between(-aside, aside));
      z.push_back(is_none || is_level ? 0 : far * rise + random.between(-aside, aside));
    }
  }
  Displacements span() const { return {x, y, z}; }
  void negate() {
    for (auto* const part : {&x, &y, &z})
      for (double& length : *part) length = -length;
  }
};

std::vector<float> times_of(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
                            const Displacements& ways, const Implementation* implementation = nullptr) {
  std::vector<float> times(pairs.size(), -1);
  time_of_impact(bodies, agents, pairs, ways, times, implementation);
  return times;
}

/// Expects the reference's times of all implementations, also of pairs the other way round; returns them.
std::vector<float> expect_times(const BodySet& bodies, const BodyCrowd& crowd, SpaceWays ways) {
  const Agents agents = crowd.agents();
  const baselines::BodyReference reference(bodies);
  std::vector<float> expected;
  for (std::size_t i = 0; i < crowd.pairs.size(); ++i)
    expected.push_back(reference.time_of_impact(agents, crowd.pairs[i], ways.x[i], ways.y[i], ways.z[i]));
  for (const Implementation& implementation : test::supported()) {
    SCOPED_TRACE(implementation.name);
    const std::vector<float> found = times_of(bodies, agents, crowd.pairs, ways.span(), &implementation);
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i], expected[i]) << "pair " << i;
  }
  ways.negate();
  EXPECT_EQ(times_of(bodies, agents, test::exchanged(crowd.pairs), ways.span()), expected);
  return expected;
}

/// Expects that some agents touch on the way, and others at once or never.
void expect_all_kinds(const std::vector<float>& times) {
  const auto now = std::count(times.begin(), times.end(), 0.0f);
  const auto never = std::count(times.begin(), times.end(), never_met);
  EXPECT_GT(now, 0);
  EXPECT_GT(never, 0);
  EXPECT_LT(now + never, static_cast<std::ptrdiff_t>(times.size()) - 100);
}

TEST(BodyImpact, CrowdsAreThoseOfTheReference) {
  Random random(5421);
  const BodySet bodies = bodies_of_all_kinds(random);
  for (const double height : {0.0, 0.17, 2.5}) {
    SCOPED_TRACE(height);
    const BodyCrowd crowd = test::random_body_crowd(random, 50, bodies.body_count(), 5, height);
    expect_all_kinds(expect_times(bodies, crowd, SpaceWays(random, crowd, 0.4)));
  }
}

TEST(BodyImpact, AnySizeAndPlace) {
  Random random(5422);
  for (const float scale : {1e-5f, 100.0f, 2e5f})
    for (const double far : {0.0, 1e7}) {
      const BodySet bodies = bodies_of_all_kinds(random, scale);
      const double side = 5 * static_cast<double>(scale);
      BodyCrowd crowd = test::random_body_crowd(random, 40, bodies.body_count(), side, 0.2 * side);
      for (double& x : crowd.x) x += far;
      expect_times(bodies, crowd, SpaceWays(random, crowd, 0.1 * side));
    }
}

TEST(BodyImpact, LongWays) {
  Random random(5423);
  const BodySet bodies = bodies_of_all_kinds(random);
  for (const double side : {1e3, 1e6, 4e8}) {
    const BodyCrowd crowd = test::random_body_crowd(random, 40, bodies.body_count(), side, side);
    expect_times(bodies, crowd, SpaceWays(random, crowd, 0.2));
  }
}

/// By the gaps of the spheres as they were given, in double, when A has gone a part of its way.
TEST(BodyImpact, NeverLateAndHardlyEarly) {
  Random random(5424);
  std::vector<std::vector<Sphere>> given;
  for (const std::uint32_t spheres : {1u, 5u, 40u}) given.push_back(test::random_body(random, spheres));
  const BodySet bodies(given);
  const BodyCrowd crowd = test::random_body_crowd(random, 60, bodies.body_count(), 6, 1);
  const SpaceWays ways(random, crowd, 0.3);
  const std::vector<float> times = times_of(bodies, crowd.agents(), crowd.pairs, ways.span());
  const auto placed = test::placed_spheres(given, crowd);
  std::size_t touched = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double time = static_cast<double>(times[i]);
    const auto gap_at = [&](double t) {
      auto moved = placed[crowd.pairs[i].first];
      for (test::PlacedSphere& s : moved) s.x += t * ways.x[i], s.y += t * ways.y[i], s.z += t * ways.z[i];
      return test::gap(moved, placed[crowd.pairs[i].second]);
    };
    const double until = std::min(time, 1.0);
    for (const double part : {0.0, 0.3, 0.7, 0.95, 0.999, 0.99999, 1.0}) {
      if (until <= 0) break;
      EXPECT_GE(gap_at(part * until), 0) << "pair " << i << " at " << part * until;
    }
    if (time == 0 || !std::isfinite(time)) continue;
    ++touched;
    const double way = std::hypot(ways.x[i], ways.y[i], ways.z[i]);
    EXPECT_LE(gap_at(time), 6e-6 * (way + 4.2)) << "pair " << i;
  }
  EXPECT_GT(touched, 300u);
}

TEST(BodyImpact, SpheresThatGraze) {
  Random random(5426);
  const BodySet bodies(std::vector<std::vector<Sphere>>{{{0, 0, 0, 0.3f}}, {{0, 0, 0, 0.2f}}});
  BodyCrowd crowd;
  std::vector<double> x, y;
  for (std::uint32_t i = 0; i < 4000; i += 2) {
    // The first one passes at the sum of the radii, to the last bits of the distance at the start.
    const double turn = random.between(-4, 4), c = std::cos(turn), s = std::sin(turn);
    const double ahead = random.between(1, 40), aside = 0.5 + random.between(-1, 4) * 0x1p-20 * ahead;
    crowd.body.insert(crowd.body.end(), {0, 1});
    crowd.x.insert(crowd.x.end(), {0, c * ahead - s * aside});
    crowd.y.insert(crowd.y.end(), {0, s * ahead + c * aside});
    crowd.z.insert(crowd.z.end(), 2, 0);
    crowd.heading.insert(crowd.heading.end(), {random.between(-4, 4), random.between(-4, 4)});
    crowd.pairs.push_back({i, i + 1});
    x.push_back(2 * ahead * c), y.push_back(2 * ahead * s);
  }
  SpaceWays ways(random, crowd, 0);
  ways.x = x, ways.y = y, ways.z.assign(x.size(), 0);
  const std::vector<float> times = expect_times(bodies, crowd, ways);
  const auto never = std::count(times.begin(), times.end(), never_met);
  EXPECT_GT(never, 100);
  EXPECT_LT(never, 1900);
}

TEST(BodyImpact, WithoutHeightsNobodyMovesUp) {
  Random random(5425);
  const BodySet bodies = bodies_of_all_kinds(random);
  const BodyCrowd crowd = test::random_body_crowd(random, 40, bodies.body_count(), 5, 0);
  SpaceWays ways(random, crowd, 0.4);
  std::fill(ways.z.begin(), ways.z.end(), 0.0);
  Agents agents = crowd.agents();
  agents.z = {};
  EXPECT_EQ(times_of(bodies, agents, crowd.pairs, {ways.x, ways.y}), expect_times(bodies, crowd, ways));
}

TEST(BodyImpact, BadInputIsNamed) {
  const BodySet bodies(std::vector<std::vector<Sphere>>{{{0, 0, 0, 0.5f}}});
  BodyCrowd crowd{{0, 0}, {0, 3}, {0, 0}, {0, 0}, {0, 0}, {{0, 1}}};
  const std::vector<double> one(1, 1.0), two(2, 1.0), high(1, 2e9), nan(1, std::nan(""));
  std::vector<float> times(1, 7);
  const auto refused = [&](const Displacements& ways) {
    return test::complaint([&] { time_of_impact(bodies, crowd.agents(), crowd.pairs, ways, times); });
  };
  EXPECT_EQ(refused({one, one, high}),
            "time_of_impact: pair 0: expected a displacement in z within +-1e9 m, found 2e+09");
  EXPECT_EQ(refused({one, one, nan}),
            "time_of_impact: pair 0: expected a displacement in z within +-1e9 m, found nan");
  EXPECT_TRUE(test::has(refused({one, one, two}), "displacements in z"));
  EXPECT_TRUE(test::has(refused({one, nan}), "pair 0"));
  EXPECT_TRUE(test::has(refused({two, one}), "displacements in x"));
  EXPECT_EQ(times[0], 7);
}

}  // namespace
}  // namespace bch
