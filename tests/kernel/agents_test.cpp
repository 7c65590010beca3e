// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/base/heading.hpp"
#include "tests/support/crowd_pairs.hpp"
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
    const bch::Crowd::Pairs found = crowd.collisions(set, agents, {.implementation = &implementation});
    pairs.assign(found.begin(), found.end());
    const bch::Crowd::Clearances near =
        crowd.clearances(set, agents, {.implementation = &implementation, .max_distance = 0.2});
    distances.assign(near.distance.begin(), near.distance.end());
    const bch::Crowd::Penetrations apart =
        crowd.penetrations(set, agents, 16, {.implementation = &implementation});
    ways.assign(apart.penetrations.begin(), apart.penetrations.end());
    const bch::Crowd::Pairs may = crowd.candidates(set, agents);
    const std::vector<double> way(may.size(), 0.5);
    times.resize(may.size());
    time_of_impact(set, agents, may.span(), {way, way}, times, &implementation);
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

/// All answers with headings as directions are those with the angles: at the origin, far from it, and where the ground repeats.
TEST(Agents, MayHaveDirections) {
  const std::vector<Shape> shapes = test::synthetic_shapes(783, 10);
  const ShapeSet set(shapes, {.depths = {0, 3, all_depths}});
  test::Random random(784);
  test::Crowd angles;
  std::vector<double> x, y;
  for (int i = 0; i < 500; ++i) {
    const auto place = [&] { return std::round(random.uniform(0, 18) * 1024) / 1024; };
    angles.add({random.below(10), place(), place(), random.uniform(-4, 4),
                static_cast<std::uint8_t>(random.below(3))});
    const detail::Rotation at = detail::rotation(angles.heading.back());
    x.push_back(at.cosine), y.push_back(at.sine);
  }
  Agents directions = angles.agents();
  directions.heading = {x, y};
  Crowd repeats({.period = {18, 18}});
  const auto sorted = [](const bch::Crowd::Pairs& pairs) { return test::sorted(pairs.span()); };
  EXPECT_EQ(sorted(repeats.collisions(set, directions)), sorted(repeats.collisions(set, angles.agents())));

  const Answers expected(set, directions, best_implementation()),
      of_angles(set, angles.agents(), best_implementation());
  EXPECT_GT(expected.pairs.size(), 100u);
  EXPECT_EQ(expected.pairs, of_angles.pairs);
  for (std::size_t i = 0; i < expected.distances.size(); ++i)
    EXPECT_NEAR(expected.distances[i], of_angles.distances[i], 1e-6);
  test::Crowd far = angles;
  for (double& value : far.x) value += 0x1p24;
  Agents far_directions = far.agents();
  far_directions.heading = {x, y};
  for (const Implementation& implementation : test::supported()) {
    EXPECT_TRUE(Answers(set, directions, implementation) == expected) << implementation.name;
    Crowd crowd;
    EXPECT_EQ(sorted(crowd.collisions(set, far_directions, {.implementation = &implementation})),
              sorted(crowd.collisions(set, directions, {.implementation = &implementation})));
  }
}

/// Agents of a crowd that is larger than a cache are fetched ahead.
TEST(Agents, MayHaveDirectionsInALargeCrowd) {
  const ShapeSet set(test::synthetic_shapes(783, 10));
  test::Random random(785);
  std::vector<std::uint32_t> shape(150'000);
  std::vector<double> at(shape.size()), x(shape.size()), y(shape.size());
  std::vector<Pair> pairs(2000);
  for (std::size_t i = 0; i < shape.size(); ++i) {
    const detail::Rotation heading = detail::rotation(random.uniform(-4, 4));
    shape[i] = random.below(10), at[i] = random.uniform(0, 2), x[i] = heading.cosine, y[i] = heading.sine;
  }
  for (Pair& pair : pairs) pair = {random.below(150'000), random.below(150'000)};
  for (const Implementation& implementation : test::supported()) {
    std::vector<std::uint8_t> hits(pairs.size());
    collide(set, {shape, at, at, {x, y}}, pairs, hits, {.implementation = &implementation});
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto [a, b] = pairs[i];
      const std::array<std::uint32_t, 2> both = {shape[a], shape[b]};
      const std::array<double, 2> place = {at[a], at[b]}, to_x = {x[a], x[b]}, to_y = {y[a], y[b]};
      const Pair only{0, 1};
      std::uint8_t hit = 2;
      collide(set, {both, place, place, {to_x, to_y}}, {&only, 1}, {&hit, 1});
      ASSERT_EQ(hits[i], hit) << implementation.name << " " << i;
    }
  }
}

TEST(Agents, AreRefusedWhereDirectionsAreNone) {
  const std::vector<Shape> shapes = test::synthetic_shapes(783, 1);
  const ShapeSet set(shapes);
  const std::vector<std::uint32_t> shape(2);
  const std::vector<double> at(2), x = {1, 0.9}, y = {0, 0.3}, one = {0};
  const auto refused = [&](const Headings& heading) {
    return test::complaint([&] { validate(set, {shape, at, at, heading}); });
  };
  EXPECT_EQ(refused({x, y}), "agent 1: expected a direction of length 0.999 to 1.001, found (0.9, 0.3)");
  EXPECT_EQ(refused({x, one}), "agents: expected 2 values of heading's y, one per shape, found 1");
  const std::vector<double> nan = {0, std::numeric_limits<double>::quiet_NaN()};
  EXPECT_EQ(refused({x, nan}), "agent 1: expected a direction of length 0.999 to 1.001, found (0.9, nan)");
  std::vector<std::uint8_t> hit(1);
  const Pair pair{0, 1};
  const std::vector<double> long_x = {1, 0.9}, long_y = {0, 0.5};
  for (const Implementation& implementation : test::supported())
    EXPECT_EQ(test::complaint([&] {
                collide(set, {shape, at, at, {long_x, long_y}}, {&pair, 1}, hit,
                        {.implementation = &implementation});
              }),
              "pair 0: agent 1: expected a direction of length 0.999 to 1.001, found (0.9, 0.5)");
  EXPECT_EQ(test::complaint([&] {
              collide(set, {shape, at, at, {x, y}}, {&pair, 1}, hit);
            }),
            "pair 0: agent 1: expected a direction of length 0.999 to 1.001, found (0.9, 0.3)");
}

TEST(Agents, AreRefusedWhereTheirNumbersAreNotAligned) {
  const std::vector<Shape> shapes = test::synthetic_shapes(781, 1);
  const ShapeSet set(shapes);
  std::vector<Walker<float>> structs(3);
  Agents agents = view(structs);
  agents.level = {}, agents.z = {};
  agents.x = Strided(&structs[0].x, 3, 6);
  EXPECT_EQ(test::complaint([&] { validate(set, agents); }),
            "agents: expected values of x at addresses that are multiples of 4, found a stride of 6");
}

}  // namespace
}  // namespace bch
