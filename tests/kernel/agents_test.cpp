// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/agents.hpp>

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include <bch/crowd.hpp>
#include <bch/pairs.hpp>

#include "tests/support/implementations.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/test.hpp"

namespace bch {
namespace {

/// What a simulator may keep of an agent.
template <class Number>
struct Walker {
  Number x, unused, y;
  std::uint32_t shape;
  Number heading;
  std::uint8_t level;
  Number z;
};

template <class Number>
Agents view(const std::vector<Walker<Number>>& all) {
  constexpr std::size_t stride = sizeof(Walker<Number>);
  const auto of = [&](const auto& first) { return Strided(&first, all.size(), stride); };
  const Walker<Number>& first = all.front();
  return {of(first.shape), of(first.x), of(first.y), of(first.heading), of(first.level), of(first.z)};
}

/// All answers about a crowd.
struct Answers {
  std::vector<Pair> pairs;
  std::vector<float> distances, times;
  std::vector<Penetration> ways;
  friend bool operator==(const Answers&, const Answers&) = default;

  Answers(const ShapeSet& set, const Agents& agents, const Implementation& implementation) {
    Crowd crowd;
    const CrowdPairs found = crowd.collisions(set, agents, {.implementation = &implementation});
    pairs.assign(found.begin(), found.end());
    const CrowdClearances near = crowd.clearances(set, agents, 0.2, {.implementation = &implementation});
    distances.assign(near.distance.begin(), near.distance.end());
    const CrowdPenetrations apart = crowd.penetrations(set, agents, {.implementation = &implementation});
    ways.assign(apart.penetrations.begin(), apart.penetrations.end());
    const CrowdPairs may = crowd.candidates(set, agents);
    const std::vector<double> way(may.size(), 0.5);
    times.resize(may.size());
    time_of_impact(set, agents, may.span(), {way, way}, times, {.implementation = &implementation});
  }
};

template <class Number>
void expect_the_answers_of_arrays(bool heights) {
  const std::vector<Shape> shapes = test::synthetic_shapes(781, 10);
  const ShapeSet set(shapes, {.depths = {0, 3, all_depths}, .heights = heights});
  test::Random random(782);
  test::Crowd arrays;
  std::vector<Walker<Number>> structs;
  for (int i = 0; i < 500; ++i) {
    // Numbers that a float holds.
    const auto number = [&](double low, double high) {
      return static_cast<float>(random.uniform(low, high));
    };
    const float x = number(0, 12), y = number(0, 12), heading = number(-4, 4), z = number(0, 1);
    const std::uint32_t shape = random.below(10);
    const auto level = static_cast<std::uint8_t>(random.below(3));
    arrays.add({shape, double{x}, double{y}, double{heading}, level});
    if (heights) arrays.z.push_back(double{z});
    structs.push_back({x, -1, y, shape, heading, level, z});
  }
  Agents agents = view(structs);
  if (!heights) agents.z = {};
  for (const Implementation& implementation : test::supported()) {
    const Answers expected(set, arrays.agents(), implementation);
    EXPECT_GT(expected.pairs.size(), 100u);
    EXPECT_TRUE(Answers(set, agents, implementation) == expected) << implementation.name;
  }
}

TEST(Agents, MayBeStructsOfDoubles) {
  expect_the_answers_of_arrays<double>(false);
  expect_the_answers_of_arrays<double>(true);
}

TEST(Agents, MayBeStructsOfFloats) {
  expect_the_answers_of_arrays<float>(false);
  expect_the_answers_of_arrays<float>(true);
}

TEST(Agents, AreRefusedWhereTheirNumbersAreNotAligned) {
  const std::vector<Shape> shapes = test::synthetic_shapes(781, 1);
  const ShapeSet set(shapes);
  std::vector<Walker<float>> structs(3);
  Agents agents = view(structs);
  agents.level = {}, agents.z = {};
  agents.x = Strided(&structs[0].x, 3, 6);
  try {
    validate(set, agents);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()),
              "agents: expected values of x at addresses that are multiples of 4, found a stride of 6");
  }
}

}  // namespace
}  // namespace bch
