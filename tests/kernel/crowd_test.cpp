// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/crowd_pairs.hpp"
#include "tests/support/query_answers.hpp"
#include "tests/support/test.hpp"

namespace bch {
namespace {

using test::all_pairs;
using test::precedes;
using test::sorted;

const ShapeSet walkers(test::synthetic_shapes(771, 12), {.depths = {0, 3, all_depths}});

/// Coordinates are multiples of 2^-20 m, so shifts by a period are exact.
test::Crowd people(std::uint32_t count, double width, double height, std::uint64_t seed) {
  test::Random random(seed);
  const auto at = [&](double length) { return std::round(random.uniform(0, length) * 0x1p20) * 0x1p-20; };
  test::Crowd crowd;
  for (std::uint32_t i = 0; i < count; ++i)
    crowd.add({random.below(walkers.shape_count()), at(width), at(height), random.uniform(-4, 4),
               static_cast<std::uint8_t>(random.below(walkers.level_count()))});
  return crowd;
}

std::vector<Pair> colliding(const Agents& agents, std::span<const Pair> pairs) {
  std::vector<std::uint8_t> hits(pairs.size());
  collide(walkers, agents, pairs, hits);
  std::vector<Pair> found;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (hits[i] != 0) found.push_back(pairs[i]);
  return found;
}

template <class Call>
void expect_refused(const std::string& words, Call call) {
  EXPECT_TRUE(test::has(test::complaint(call), words));
}

TEST(Crowd, FindsThePairsThatCollide) {
  Crowd crowd;
  for (const std::uint32_t count : {0u, 1u, 300u, 20u, 900u}) {
    const test::Crowd in = people(count, 12, 12, count);
    const std::vector<Pair> expected = colliding(in.agents(), all_pairs(count));
    const bch::Crowd::Pairs found = crowd.collisions(walkers, in.agents());
    EXPECT_EQ(sorted(found.span()), expected);
    EXPECT_EQ(expected.empty(), count < 2);
    std::vector<std::vector<std::uint32_t>> neighbours(count);
    for (const auto [a, b] : expected) neighbours[a].push_back(b), neighbours[b].push_back(a);
    for (auto& row : neighbours) std::sort(row.begin(), row.end());
    EXPECT_EQ(test::neighbours(found), neighbours);
    const Rows<bch::Crowd::Neighbour> rows = found.by_agent();
    for (std::uint32_t i = 0; i < rows.size(); ++i)
      for (const bch::Crowd::Neighbour& other : rows[i])
        EXPECT_EQ(found[other.pair], (Pair{std::min(i, other.agent), std::max(i, other.agent)}));
  }
}

/// Returns the nearest of each agent, by all distances of a crowd.
template <class Clearances>
void expect_nearest(const Clearances& found, std::uint32_t agents, std::uint32_t most) {
  std::vector<std::vector<std::pair<float, std::uint32_t>>> expected(agents);
  for (std::size_t k = 0; k < found.pairs.size(); ++k) {
    const auto [a, b] = found.pairs[k];
    expected[a].emplace_back(found.distance[k], b), expected[b].emplace_back(found.distance[k], a);
  }
  const Rows<bch::Crowd::Neighbour> rows = found.nearest(most);
  ASSERT_EQ(rows.size(), agents);
  for (std::uint32_t i = 0; i < agents; ++i) {
    std::sort(expected[i].begin(), expected[i].end());
    expected[i].resize(std::min<std::size_t>(most, expected[i].size()));
    std::vector<std::pair<float, std::uint32_t>> row;
    for (const auto& [agent, pair] : rows[i]) row.emplace_back(found.distance[pair], agent);
    ASSERT_EQ(row, expected[i]) << i;
  }
}

TEST(Crowd, TellsTheNearestOfEach) {
  Crowd crowd;
  const test::Crowd in = people(900, 12, 12, 8);
  for (const std::uint32_t most : {3u, 0u, 1000u})
    expect_nearest(crowd.clearances(walkers, in.agents(), {.max_distance = 0.5, .overlap = Overlap::deepest}),
                   900, most);
  EXPECT_EQ(bch::Crowd::Clearances{}.nearest(5).size(), 0u);
}

/// Returns what disc_radii() promises, agent by agent, of a crowd whose period along x is a multiple of 2^-20 m.
template <class Clearances>
std::vector<double> mean_radii(const Clearances& found, const test::Crowd& in, double period, double alone) {
  std::vector<double> radii;
  for (std::uint32_t i = 0; i < in.agents().size(); ++i) {
    double sum = 0, weights = 0;
    for (std::size_t k = 0; k < found.pairs.size(); ++k) {
      const auto [a, b] = found.pairs[k];
      if (a != i && b != i) continue;
      double x = std::abs(in.agents().x[a] - in.agents().x[b]);
      if (period > 0) x = std::min(x, period - x);
      const double gap{found.distance[k]}, y = in.agents().y[a] - in.agents().y[b],
                                           weight = std::pow(std::max(gap, 0.0) + 0.1, -2);
      sum += weight * std::max(0.0, std::hypot(x, y) - gap) / 2, weights += weight;
    }
    radii.push_back(weights > 0 ? sum / weights : alone);
  }
  return radii;
}

TEST(Crowd, DiscsStandForBodiesAmongTheirNeighbours) {
  const test::Crowd in = people(300, 40, 40, 9);
  for (const double period : {0.0, 40.0}) {
    Crowd crowd(bch::CrowdOptions{.period = {.x = period}});
    const auto found =
        crowd.clearances(walkers, in.agents(), {.max_distance = 0.5, .overlap = Overlap::deepest});
    const std::vector<double> radii = found.disc_radii(in.agents(), 7);
    const std::vector<double> expected = mean_radii(found, in, period, 7);
    ASSERT_EQ(radii.size(), expected.size());
    for (std::size_t i = 0; i < radii.size(); ++i) EXPECT_NEAR(radii[i], expected[i], 1e-12) << i;
    const auto alone = std::ranges::count(radii, 7.0);
    EXPECT_GT(alone, 0);
    EXPECT_LT(alone, 300);
    const test::Crowd others = people(299, 40, 40, 9);
    expect_refused("disc_radii: expected the 300 agents of the clearances, found 299",
                   [&] { (void)found.disc_radii(others.agents(), 7); });
  }
  EXPECT_EQ(bch::Crowd::Clearances{}.disc_radii(in.agents(), 2), std::vector<double>(300, 2));
}

TEST(Crowd, MeasuresThePairsThatItFinds) {
  Crowd crowd;
  const test::PairScene in{people(600, 12, 12, 7), all_pairs(600)};
  const Agents agents = in.crowd.agents();
  for (const double within : {0.0, 0.25}) {
    const auto all = nearest_features(walkers, in, {.max_distance = within, .overlap = Overlap::deepest});
    const auto is_near = [&](const auto& each) { return double{each.distance} <= within; };
    const bch::Crowd::Clearances found =
        crowd.clearances(walkers, agents, {.max_distance = within, .overlap = Overlap::deepest});
    EXPECT_EQ(std::ranges::count_if(all, is_near), std::ssize(found.distance));
    EXPECT_GT(found.pairs.size(), 100u);
    for (std::size_t k = 0; k < found.pairs.size(); ++k) {
      const auto at = std::ranges::lower_bound(in.pairs, found.pairs[k], precedes) - in.pairs.begin();
      ASSERT_EQ(in.pairs[static_cast<std::size_t>(at)], found.pairs[k]);
      EXPECT_LE(double{found.distance[k]}, within);
      EXPECT_TRUE((test::NearestFeatures{found.distance[k], found.direction[k], found.discs[k],
                                         found.points[k]} == all[static_cast<std::size_t>(at)]));
    }
  }
  const bch::Crowd::Penetrations apart = crowd.penetrations(walkers, agents, 8);
  EXPECT_EQ(sorted(apart.pairs.span()), colliding(agents, in.pairs));
  std::vector<Penetration> expected(apart.pairs.size());
  penetration(walkers, agents, apart.pairs.span(), 8, expected);
  EXPECT_TRUE(std::ranges::equal(apart.penetrations, expected));
}

TEST(Crowd, FiltersAsPhysicsEnginesDo) {
  const test::Crowd in = people(400, 9, 9, 11);
  test::Random random(12);
  std::vector<std::uint32_t> category, mask;
  for (int i = 0; i < 400; ++i) category.push_back(1u << random.below(3)), mask.push_back(random.below(8));
  const std::vector<Pair> unfiltered = colliding(in.agents(), all_pairs(400));
  std::vector<Pair> excluded, expected;
  for (std::size_t i = 0; i < unfiltered.size(); i += 5)
    excluded.push_back(i % 2 == 0 ? unfiltered[i] : Pair{unfiltered[i].second, unfiltered[i].first});
  for (std::size_t i = 0; i < unfiltered.size(); ++i) {
    const auto [a, b] = unfiltered[i];
    if (i % 5 != 0 && (mask[a] & category[b]) != 0 && (mask[b] & category[a]) != 0)
      expected.push_back(unfiltered[i]);
  }
  ASSERT_GT(expected.size(), 20u);
  Crowd crowd;
  const PairFilter filter{category, mask, excluded};
  EXPECT_EQ(sorted(crowd.collisions(walkers, in.agents(), {}, filter).span()), expected);
  EXPECT_EQ(colliding(in.agents(), sorted(crowd.candidates(walkers, in.agents(), 0, filter).span())),
            expected);
  EXPECT_EQ(sorted(crowd.penetrations(walkers, in.agents(), 16, {}, filter).pairs.span()), expected);

  EXPECT_EQ(sorted(crowd.collisions(walkers, in.agents()).span()), unfiltered);
  category.pop_back();
  expect_refused("filter: expected 400 values of category, one per agent, or none, found 399",
                 [&] { crowd.collisions(walkers, in.agents(), {}, {.category = category}); });
  const Pair beyond{3, 400};
  expect_refused("filter: excluded pair 0: expected one of 400 agents, found 400", [&] {
    crowd.candidates(walkers, in.agents(), 0, {.excluded = {&beyond, 1}});
  });
}

/// A crowd on a ground that repeats, by brute force: each pair with each of the nine shifts of its second agent.
struct Periodic {
  CrowdOptions::Period period;
  test::Crowd in;

  struct Answer {
    bool hit = false;
    float distance = std::numeric_limits<float>::infinity();
    Penetration way = {};
  };

  Answer answer(Pair pair) const {
    Answer all;
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j) {
        if ((i != 0 && period.x == 0) || (j != 0 && period.y == 0)) continue;
        test::Crowd two;
        for (const std::uint32_t agent : {pair.first, pair.second})
          two.add({in.shape[agent], in.x[agent], in.y[agent], in.heading[agent], in.level[agent]});
        two.x[1] += i * period.x, two.y[1] += j * period.y;
        const Pair both{0, 1};
        std::uint8_t hit = 0;
        collide(walkers, two.agents(), {&both, 1}, {&hit, 1});
        float distance = 0;
        clearance(walkers, two.agents(), {&both, 1}, {{&distance, 1}}, {.max_distance = 0.25});
        all.distance = std::min(all.distance, distance);
        if (hit == 0) continue;
        all.hit = true;
        penetration(walkers, two.agents(), {&both, 1}, 16, {&all.way, 1});
      }
    return all;
  }
};

/// What is said of each pair.
using ByPair = std::map<std::pair<std::uint32_t, std::uint32_t>, float>;

template <class Value>
ByPair by_pair(const bch::Crowd::Pairs& pairs, Value value) {
  ByPair all;
  for (std::size_t k = 0; k < pairs.size(); ++k) all[{pairs[k].first, pairs[k].second}] = value(k);
  EXPECT_EQ(all.size(), pairs.size());
  return all;
}

TEST(Crowd, MeetsItselfAcrossTheBordersOfAPeriod) {
  const test::Crowd close = people(200, 1, 1, 1);
  Crowd small({.period = {1, 1}});
  const std::string words = "crowd: expected a period along x of more than ",
                    said = test::complaint([&] { small.collisions(walkers, close.agents()); });
  ASSERT_TRUE(said.starts_with(words)) << said;
  const double least = std::stod(said.substr(words.size()));
  ASSERT_GT(least, 1);
  const double side = std::ceil(least + 6);
  for (const CrowdOptions::Period period :
       {CrowdOptions::Period{side, side}, CrowdOptions::Period{side, 0}, CrowdOptions::Period{0, side}}) {
    Periodic expected{period, people(250, side, side, 31)};
    test::Crowd moved = expected.in;
    for (std::size_t i = 0; i < moved.x.size(); ++i) {
      if (period.x > 0) moved.x[i] += side * (static_cast<double>(i % 7) - 3);
      if (period.y > 0) moved.y[i] -= side * static_cast<double>(i % 5);
    }
    Crowd crowd({.period = period}), closed;
    const std::size_t inside = closed.collisions(walkers, expected.in.agents()).size();
    std::vector<Pair> hits;
    ByPair near, depths;
    for (const Pair pair : all_pairs(250)) {
      const Periodic::Answer of = expected.answer(pair);
      if (of.hit) hits.push_back(pair), depths[{pair.first, pair.second}] = of.way.depth;
      if (of.distance <= 0.25f) near[{pair.first, pair.second}] = of.distance;
    }
    EXPECT_GT(hits.size(), inside + 5);
    for (const test::Crowd* in : {&expected.in, &moved}) {
      EXPECT_EQ(sorted(crowd.collisions(walkers, in->agents()).span()), hits);
      const std::vector<Pair> candidates = sorted(crowd.candidates(walkers, in->agents()).span());
      EXPECT_TRUE(std::includes(candidates.begin(), candidates.end(), hits.begin(), hits.end(), precedes));
      EXPECT_EQ(std::adjacent_find(candidates.begin(), candidates.end()), candidates.end());
      EXPECT_LE(sorted(crowd.contacts(walkers, in->agents()).pairs.span()).size(), hits.size());

      const bch::Crowd::Clearances found = crowd.clearances(walkers, in->agents(), {.max_distance = 0.25});
      EXPECT_EQ(by_pair(found.pairs, [&](std::size_t k) { return found.distance[k]; }), near);
      const bch::Crowd::Penetrations apart = crowd.penetrations(walkers, in->agents());
      EXPECT_EQ(by_pair(apart.pairs, [&](std::size_t k) { return apart.penetrations[k].depth; }), depths);
    }
  }
}

TEST(Crowd, RefusesPeriodsAndPairsThatDoNotFit) {
  for (const double bad : {-1.0, 6e8, std::numeric_limits<double>::quiet_NaN()})
    expect_refused("crowd: expected a period along y from 0 to 5e8 m",
                   [&] { Crowd crowd({.period = {.y = bad}}); });
  const test::Crowd in = people(10, 9, 9, 3);
  const Pair pair{0, 1};
  Crowd crowd({.period = {500, 0}});
  expect_refused("contacts: expected a crowd without a period", [&] {
    crowd.contacts(walkers, in.agents(), {&pair, 1});
  });
  for (const double bad : {-0.1, 3e9, std::numeric_limits<double>::quiet_NaN()})
    expect_refused("candidates: expected a margin from 0 to 2e9 m",
                   [&] { crowd.candidates(walkers, in.agents(), bad); });
}

/// Answers may not outlive the crowd that holds them.
template <class Of>
concept AnswersOf = requires(const ShapeSet& in, const Agents& agents) {
  std::declval<Of>().collisions(in, agents);
};
static_assert(AnswersOf<Crowd&> && !AnswersOf<Crowd>);

}  // namespace
}  // namespace bch
