// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/runtime/all_options.hpp"
#include "tests/support/test.hpp"

// What collide() refuses, and that it does nothing then.

namespace bch {
namespace {

class BadInput : public testing::Test {
 protected:
  std::vector<Shape> shapes = test::synthetic_shapes(1, 2);
  ShapeSet set{shapes};
  test::Crowd crowd;
  std::vector<Pair> pairs = {{0, 1}};

  void SetUp() override {
    crowd.add({0, 0, 0, 0, 0});
    crowd.add({1, 1, 0, 0, 0});
  }

  void expect_rejected(const std::string& message, const detail::AllOptions& options = {}) {
    std::vector<std::uint8_t> hits(pairs.size(), 42);
    try {
      collide(set, crowd.agents(), pairs, hits, options);
      FAIL() << "accepted; expected: " << message;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
    for (const std::uint8_t hit : hits) EXPECT_EQ(hit, 42);
  }
};

TEST_F(BadInput, NamesTheAgentOrPairAndTheValue) {
  pairs.push_back({0, 2});
  expect_rejected("pair 1: agent 2 of 2");
  pairs = {{0, 0}, {1, 0}};
  crowd.shape[1] = 2;
  expect_rejected("pair 1: agent 1: shape 2 of 2");
  crowd.shape[1] = 1;
  crowd.level[1] = 1;
  expect_rejected("pair 1: agent 1: level 1 of 1");
  crowd.level[1] = 0;
  crowd.x[1] = std::numeric_limits<double>::quiet_NaN();
  expect_rejected("pair 1: agent 1: position (nan, 0)");
  crowd.x[1] = -2e9;
  expect_rejected("position (-2e+09, 0)");
  crowd.x[1] = 1'000'000'000.5;
  expect_rejected("position (1000000000.5, 0)");
  crowd.x[1] = 0;
  crowd.heading[1] = std::numeric_limits<double>::infinity();
  expect_rejected("heading inf");
}

TEST_F(BadInput, AnAgentThatNoPairNamesMayBeAnything) {
  crowd.add({99, std::numeric_limits<double>::quiet_NaN(), 0, 0, 7});
  for (const std::size_t count : {1u, 2u, 50u}) {
    pairs.assign(count, {0, 1});
    std::vector<std::uint8_t> hits(count);
    EXPECT_NO_THROW(collide(set, crowd.agents(), pairs, hits)) << count;
    pairs.push_back({2, 1});
    expect_rejected("pair " + std::to_string(count) + ": agent 2: shape 99 of 2");
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
      expect_rejected(first + ": agent " + std::to_string(agent) + ": shape 2 of 2", options);
      crowd.shape[agent] = 0;
    }
    pairs.push_back({99, 100});
    expect_rejected("pair 3: agent 100 of 100", options);
    pairs.pop_back();
  }
}

// Batches of up to a chunk are looked at while they are answered.
TEST_F(BadInput, AnyValueInAnyPlaceOfABatch) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                   infinity = std::numeric_limits<double>::infinity();
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
          const std::string where = "pair " + std::to_string(place) + ": agent ";
          const auto expect_each = [&](auto& value, std::initializer_list<double> bad) {
            const auto good = value;
            for (const double each : bad) {
              value = static_cast<std::decay_t<decltype(value)>>(each);
              SCOPED_TRACE(std::string(implementation.name) + ", " + std::to_string(size) + " pairs, " +
                           std::to_string(each));
              expect_rejected(where, options);
            }
            value = good;
          };
          expect_each(crowd.shape[agent], {2, 3, 4e9});
          expect_each(crowd.level[agent], {1, 255});
          for (auto* const values : {&crowd.x, &crowd.y, &crowd.heading})
            expect_each((*values)[agent], {nan, infinity, -infinity, 1'000'000'000.5, -1e300});
          expect_each(agent % 2 == 0 ? pairs[place].second : pairs[place].first, {2.0 * size, 4294967295.0});
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

TEST_F(BadInput, LeavesThatThereAreNot) {
  expect_rejected("collide: no leaves are 2", {.leaves = static_cast<Leaves>(2)});
  expect_rejected("collide: no leaves are -1", {.leaves = static_cast<Leaves>(-1)});
  bch::Crowd finder;
  EXPECT_THROW(finder.collisions(set, crowd.agents(), {.leaves = static_cast<Leaves>(2)}),
               std::invalid_argument);
}

TEST_F(BadInput, SizesThatDiffer) {
  crowd.y.pop_back();
  expect_rejected("2 shapes but 1 values of y");
  crowd.y.push_back(0);
  std::vector<std::uint8_t> hits(2);
  EXPECT_THROW(collide(set, crowd.agents(), pairs, hits), std::invalid_argument);
}

}  // namespace
}  // namespace bch
