// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/runtime/all_options.hpp"
#include "tests/support/test.hpp"

// What collide() refuses, and that it does nothing then.

namespace bch {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
using test::infinity;

class TwoAgents : public testing::Test {
 protected:
  TwoAgents() { crowd.add({0, 0, 0, 0, 0}), crowd.add({1, 1, 0, 0, 0}); }

  std::vector<Shape> shapes = test::synthetic_shapes(1, 2);
  ShapeSet set{shapes};
  test::Crowd crowd;
};

class BadInput : public TwoAgents {
 protected:
  std::vector<Pair> pairs = {{0, 1}};

  void expect_rejected(const std::string& message, const detail::AllOptions& options = {}) {
    std::vector<std::uint8_t> hits(pairs.size(), 42);
    EXPECT_TRUE(
        test::has(test::complaint([&] { collide(set, crowd.agents(), pairs, hits, options); }), message));
    for (const std::uint8_t hit : hits) EXPECT_EQ(hit, 42);
  }
};

TEST_F(BadInput, AnAgentThatNoPairNamesMayBeAnything) {
  crowd.add({99, nan, 0, 0, 7});
  for (const std::size_t count : {1u, 2u, 50u}) {
    pairs.assign(count, {0, 1});
    std::vector<std::uint8_t> hits(count);
    EXPECT_NO_THROW(collide(set, crowd.agents(), pairs, hits)) << count;
    pairs.push_back({2, 1});
    expect_rejected("pair " + std::to_string(count) + ": agent 2: expected one of 2 shapes, found 99");
  }
}

TEST_F(BadInput, AFewOfManyAgents) {
  for (int i = 0; i < 98; ++i) crowd.add({0, 100.0 + 10 * i, 0, 0, 0});
  pairs = {{43, 40}, {41, 43}, {41, 40}};
  crowd.shape[39] = crowd.shape[42] = crowd.shape[44] = 2;
  for (const Implementation& implementation : test::supported()) {
    detail::AllOptions options{.implementation = &implementation};
    std::vector<std::uint8_t> hits(pairs.size());
    EXPECT_NO_THROW(collide(set, crowd.agents(), pairs, hits, options)) << implementation.name;
    for (const std::uint32_t agent : {40u, 41u, 43u}) {
      crowd.shape[agent] = 2;
      const std::string first = agent == 41 ? "pair 1" : "pair 0";
      expect_rejected(first + ": agent " + std::to_string(agent) + ": expected one of 2 shapes, found 2",
                      options);
      crowd.shape[agent] = 0;
    }
    pairs.push_back({99, 100});
    expect_rejected("pair 3: expected one of 100 agents, found 100", options);
    pairs.pop_back();
  }
}

// Batches of up to a packet are looked at while they are answered.
TEST_F(BadInput, AnyValueInAnyPlaceOfABatch) {
  for (const Implementation& implementation : test::supported()) {
    const detail::AllOptions options{.implementation = &implementation};
    for (const std::uint32_t size : {1, 2, 5, 15, 16, 17, 33, 255, 256, 257}) {
      crowd = {};
      pairs.clear();
      for (std::uint32_t i = 0; i < size; ++i) {
        pairs.push_back({2 * i + 1, 2 * i});
        for (const double x : {0.0, 0.3}) crowd.add({i % 2, 10.0 * i + x, x, 0.1 * i, 0});
      }
      for (const std::uint32_t place : {0u, size / 2, size - 1})
        for (const std::uint32_t agent : {2 * place, 2 * place + 1}) {
          const std::string pair = "pair " + std::to_string(place) + ": ";
          const auto expect_each = [&](auto& value, std::initializer_list<double> bad,
                                       const char* words = "agent ") {
            const auto good = value;
            for (const double each : bad) {
              value = static_cast<std::decay_t<decltype(value)>>(each);
              SCOPED_TRACE(std::string(implementation.name) + ", " + std::to_string(size) + " pairs, " +
                           std::to_string(each));
              expect_rejected(pair + words, options);
            }
            value = good;
          };
          expect_each(crowd.shape[agent], {2, 3, 4e9});
          expect_each(crowd.level[agent], {1, 255});
          for (auto* const values : {&crowd.x, &crowd.y, &crowd.heading})
            expect_each((*values)[agent], {nan, infinity, -infinity, 1'000'000'000.5, -1e300});
          expect_each(agent % 2 == 0 ? pairs[place].second : pairs[place].first, {2.0 * size, 4294967295.0},
                      "expected one of ");
        }
      std::vector<std::uint8_t> hits(size);
      EXPECT_NO_THROW(collide(set, crowd.agents(), pairs, hits, options));
    }
  }
}

TEST_F(BadInput, TheLargestValuesAreValid) {
  for (const Implementation& implementation : test::supported()) {
    for (const double far : {4.9e8, 5.1e8, 1e9}) {
      crowd = {};
      crowd.add({0, far, -far, far, 0});
      crowd.add({1, far, -far, -far, 0});
      crowd.add({1, -far, far, far, 0});
      for (const std::uint32_t size : {1, 16, 256, 300}) {
        pairs.assign(size, {0, 1});
        pairs.back() = {0, 2};
        std::vector<std::uint8_t> hits(size, 42);
        collide(set, crowd.agents(), pairs, hits, {.implementation = &implementation});
        for (std::uint32_t i = 0; i < size; ++i)
          EXPECT_EQ(hits[i], i + 1 < size) << implementation.name << far;
      }
    }
  }
}

// ---- What other queries over pairs refuse: agents and pairs of every kind are those of collide() above.

/// Two pairs, and room for two answers of every query.
class QueryInput : public TwoAgents {
 protected:
  /// Expects that a call is refused with these words, and that no answer is written.
  template <class Call>
  void expect_refused(const std::string& words, Call call) {
    EXPECT_TRUE(test::has(test::complaint(call), words));
    EXPECT_EQ(hits, std::vector<std::uint8_t>(2, 42)) << words;
    EXPECT_EQ(floats, std::vector<float>(2, 42)) << words;
    EXPECT_EQ(depths, std::vector<Penetration>(2, {42, 42, 42})) << words;
  }

  void expect_refused_by_all(const std::string& words) {
    const Agents agents = crowd.agents();
    expect_refused(words, [&] { collide(set, agents, pairs, hits); });
    expect_refused(words, [&] { clearance(set, agents, pairs, {floats}); });
    expect_refused(words, [&] { within(set, agents, pairs, distances, hits); });
    expect_refused(words, [&] { time_of_impact(set, agents, pairs, {way, way}, floats); });
    expect_refused(words, [&] { penetration(set, agents, pairs, 4, depths); });
    expect_refused(words, [&] { penetration_along(set, agents, pairs, directions, depths); });
    expect_refused(words, [&] { finder.contacts(set, agents, pairs); });
  }

  Crowd finder;
  std::vector<Pair> pairs = {{0, 1}, {1, 0}};
  std::vector<double> distances = {1, 1}, way = {1, 1};
  std::vector<Vec2> directions = {{1, 0}, {1, 0}};
  std::vector<std::uint8_t> hits = {42, 42};
  std::vector<float> floats = {42, 42};
  std::vector<Penetration> depths = {{42, 42, 42}, {42, 42, 42}};
};

TEST_F(QueryInput, AgentsAreNamed) {
  pairs[1] = {0, 2};
  expect_refused_by_all("pair 1: expected one of 2 agents, found 2");
  pairs[0] = {0, 0}, pairs[1] = {1, 0};
  const auto expect_named = [&](auto& value, auto bad, const std::string& words) {
    const auto good = std::exchange(value, bad);
    expect_refused_by_all(words);
    value = good;
  };
  expect_named(crowd.shape[1], 2u, "pair 1: agent 1: expected one of 2 shapes, found 2");
  expect_named(crowd.level[1], std::uint8_t{1}, "pair 1: agent 1: expected one of 1 levels, found 1");
  expect_named(crowd.x[1], 1'000'000'000.5,
               "pair 1: agent 1: expected a position within +-1e9 m, found (1000000000.5, 0)");
  expect_named(crowd.y[1], nan, "pair 1: agent 1: expected a position within +-1e9 m, found (1, nan)");
  expect_named(crowd.y[1], -2e9, "pair 1: agent 1: expected a position within +-1e9 m, found (1, -2e+09)");
  expect_named(crowd.heading[1], infinity, "pair 1: agent 1: expected a heading within +-1e9 rad, found inf");
  crowd.y.pop_back();
  expect_refused_by_all("expected 2 values of y, one per shape, found 1");
}

TEST_F(QueryInput, ValuesAreNamed) {
  const Agents agents = crowd.agents();
  for (const double bad : {nan, -0.5}) {
    expect_refused("expected a max_distance of at least 0 m, found " + std::string(bad < 0 ? "-0.5" : "nan"),
                   [&] { clearance(set, agents, pairs, {floats}, {.max_distance = bad}); });
    distances[1] = bad;
    expect_refused(
        "within: pair 1: expected a distance of at least 0 m, found " + std::string(bad < 0 ? "-0.5" : "nan"),
        [&] { within(set, agents, pairs, distances, hits); });
    expect_refused(
        "within: expected a distance of at least 0 m, found " + std::string(bad < 0 ? "-0.5" : "nan"), [&] {
          within(set, agents, pairs, {&bad, 1}, hits);
        });
  }
  for (const double bad : {nan, -2e9}) {
    way[1] = bad;
    expect_refused(
        "pair 1: expected a displacement within +-1e9 m, found (" + std::string(bad < 0 ? "-2e+09" : "nan"),
        [&] {
          time_of_impact(set, agents, pairs, {way, way}, floats);
        });
  }
  for (const Vec2 bad : {Vec2{0, 0}, {-0.0f, 0}, {NAN, 1}, {1, HUGE_VALF}}) {
    directions[1] = bad;
    expect_refused("pair 1: expected a finite direction other than (0, 0), found (",
                   [&] { penetration_along(set, agents, pairs, directions, depths); });
  }
  for (const std::uint32_t lines : {0u, 1u, 3u, 255u, 258u, ~0u})
    expect_refused("even number of directions from 2 to 256, found " + std::to_string(lines),
                   [&] { penetration(set, agents, pairs, lines, depths); });
  EXPECT_NO_THROW(penetration(set, agents, pairs, 256, depths));
}

TEST_F(QueryInput, SizesAreNamed) {
  const Agents agents = crowd.agents();
  const std::vector<double> three(3, 1.0);
  const auto one = [](auto& values) { return std::span(values).first(1); };
  expect_refused("expected 2 hits, one per pair, found 1", [&] { collide(set, agents, pairs, one(hits)); });
  expect_refused("expected 2 distances, one per pair, found 1",
                 [&] { clearance(set, agents, pairs, {one(floats)}); });
  expect_refused("expected 2 distances, one per pair, found 0", [&] {
    clearance(set, agents, pairs, {{}, directions});
  });
  expect_refused("expected 2 directions, one per pair, found 1", [&] {
    clearance(set, agents, pairs, {floats, one(directions)});
  });
  std::vector<DiscPair> discs(1);
  expect_refused("expected 2 discs, one per pair, found 1", [&] {
    clearance(set, agents, pairs, {floats, {}, discs});
  });
  std::vector<NearestPoints> points(1);
  expect_refused("expected 2 points, one per pair, found 1", [&] {
    clearance(set, agents, pairs, {floats, {}, {}, points});
  });
  expect_refused("within: expected 2 distances, one per pair, found 0",
                 [&] { within(set, agents, pairs, {}, hits); });
  expect_refused("within: expected 2 distances, one per pair, found 3",
                 [&] { within(set, agents, pairs, three, hits); });
  expect_refused("within: expected 2 answers, one per pair, found 1",
                 [&] { within(set, agents, pairs, distances, one(hits)); });
  expect_refused("expected 2 displacements in y, one per pair, found 0", [&] {
    time_of_impact(set, agents, pairs, {way, {}}, floats);
  });
  expect_refused("expected 2 displacements in x, one per pair, found 3", [&] {
    time_of_impact(set, agents, pairs, {three, way}, floats);
  });
  expect_refused("expected no displacements in z of outlines, found 2", [&] {
    time_of_impact(set, agents, pairs, {way, way, way}, floats);
  });
  expect_refused("expected 2 times, one per pair, found 1", [&] {
    time_of_impact(set, agents, pairs, {way, way}, one(floats));
  });
  expect_refused("expected 2 directions, one per pair, found 1",
                 [&] { penetration_along(set, agents, pairs, one(directions), depths); });
  expect_refused("penetration: expected 2 answers, one per pair, found 1",
                 [&] { penetration(set, agents, pairs, 4, one(depths)); });
}

TEST_F(QueryInput, OptionsThatThereAreNot) {
  const Agents agents = crowd.agents();
  const auto leaves = static_cast<Leaves>(7);
  expect_refused("collide: expected leaves of 0 (discs) or 1 (segments), found 7",
                 [&] { collide(set, agents, pairs, hits, {.leaves = leaves}); });
  expect_refused("collide: expected leaves of 0 (discs) or 1 (segments), found -1",
                 [&] { collide(set, agents, pairs, hits, {.leaves = static_cast<Leaves>(-1)}); });
  EXPECT_THROW(finder.collisions(set, agents, {.leaves = leaves}), std::invalid_argument);
  EXPECT_THROW(finder.contacts(set, agents, pairs, {.leaves = leaves}), std::invalid_argument);
  EXPECT_THROW(finder.contacts(set, agents, {.leaves = leaves}), std::invalid_argument);
  EXPECT_THROW(clearance(set, agents, pairs, {floats}, {.leaves = leaves}), std::invalid_argument);
  expect_refused("expected an overlap of 0 (zero) or 1 (deepest), found 2",
                 [&] { clearance(set, agents, pairs, {floats}, {.overlap = Overlap{2}}); });
}

TEST_F(QueryInput, OfWholeCrowdsIsNamed) {
  crowd.x[1] = nan;
  expect_refused("agent 1: expected a position within +-1e9 m, found (nan, 0)",
                 [&] { finder.collisions(set, crowd.agents()); });
  expect_refused("agent 1: expected a position within +-1e9 m, found (nan, 0)",
                 [&] { finder.contacts(set, crowd.agents()); });
  expect_refused("agent 1: expected a position within +-1e9 m, found (nan, 0)",
                 [&] { finder.candidates(set, crowd.agents()); });
  crowd.x[1] = 0, crowd.shape[1] = 2;
  expect_refused("agent 1: expected one of 2 shapes, found 2",
                 [&] { finder.candidates(set, crowd.agents()); });
}

/// Rows that were found before stay as they are.
TEST_F(QueryInput, LeavesTheLastContacts) {
  crowd.x[1] = 0;
  const Rows<DiscPair> rows = finder.contacts(set, crowd.agents(), pairs);
  const std::vector<std::uint64_t> offsets(rows.offsets.begin(), rows.offsets.end());
  const std::vector<DiscPair> contacts(rows.values.begin(), rows.values.end());
  EXPECT_FALSE(contacts.empty());
  crowd.heading[1] = nan;
  expect_refused("pair 0: agent 1: expected a heading within +-1e9 rad, found nan",
                 [&] { finder.contacts(set, crowd.agents(), pairs); });
  EXPECT_TRUE(std::ranges::equal(rows.offsets, offsets));
  EXPECT_TRUE(std::ranges::equal(rows.values, contacts));
}

}  // namespace
}  // namespace bch
