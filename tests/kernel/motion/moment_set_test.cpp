// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/crowd_pairs.hpp"
#include "tests/support/moments.hpp"
#include "tests/support/moving_bodies.hpp"
#include "tests/support/test.hpp"
#include "tests/support/test_characters.hpp"

// Agents who show bodies that move by themselves, each at a time of its own.

namespace bch {
namespace {

using test::distances;
using test::Moments;
using test::Players;
using test::Random;

/// A set that has the shape of each agent at its time, and agents who show these.
struct OwnShapes {
  OwnShapes(std::span<const AnimatedShape> bodies, const Players& players, const ShapeSetPlan& plan)
      : set(shapes_of(bodies, players), plan), own(players.body.size()) {
    std::iota(own.begin(), own.end(), 0u);
    agents = {own, players.x, players.y, players.heading};
  }
  static std::vector<Shape> shapes_of(std::span<const AnimatedShape> bodies, const Players& players) {
    std::vector<Shape> each;
    for (std::size_t i = 0; i < players.body.size(); ++i)
      each.push_back(bodies[players.body[i]].shape(players.seconds[i]));
    return each;
  }

  ShapeSet set;
  std::vector<std::uint32_t> own;
  Agents agents;
};

/// Everything that a query can tell of pairs and of agents near obstacles, at the level of all depths.
struct AllAnswers {
  std::vector<std::uint8_t> hits, near, at_walls;
  std::vector<float> distance, time, to_walls;
  std::vector<Penetration> depth;
  std::vector<DiscPair> contacts;
  std::vector<std::uint64_t> offsets;
  friend bool operator==(const AllAnswers&, const AllAnswers&) = default;

  AllAnswers(const ShapeSet& set, const Agents& agents, std::span<const Pair> pairs, const ObstacleSet& walls)
      : hits(pairs.size()),
        near(pairs.size()),
        at_walls(agents.shape.size()),
        distance(distances(set, agents, pairs)),
        time(pairs.size()),
        to_walls(agents.shape.size()),
        depth(pairs.size()) {
    collide(set, agents, pairs, hits);
    const double within_metres[] = {0.125};
    within(set, agents, pairs, within_metres, near);
    const std::vector<double> way(pairs.size(), 0.5), back(pairs.size(), -0.25);
    time_of_impact(set, agents, pairs, {way, back}, time);
    penetration(set, agents, pairs, 8, depth);
    bch::Crowd finder;
    const Rows<DiscPair> found = finder.contacts(set, agents, pairs);
    contacts.assign(found.values.begin(), found.values.end());
    offsets.assign(found.offsets.begin(), found.offsets.end());
    collide(set, agents, walls, at_walls);
    clearance(set, agents, walls, {to_walls, {}, {}, {}});
  }
};

std::vector<const AnimatedShape*> pointers(const std::vector<AnimatedShape>& shapes) {
  std::vector<const AnimatedShape*> bodies;
  for (const AnimatedShape& shape : shapes) bodies.push_back(&shape);
  return bodies;
}

/// Answers are those of a set that has the shape of each agent, however many there are from call to call.
void expect_own_shapes(Random& random, const std::vector<AnimatedShape>& shapes, const ShapeSetPlan& plan,
                       const std::vector<std::uint32_t>& counts) {
  const std::vector<const AnimatedShape*> bodies = pointers(shapes);
  const ObstacleSet walls = obstacles_from_wkt("LINESTRING (0 0, 4 5, 3 6) POLYGON ((6 6, 7 6, 7 7, 6 6))");
  MomentSet moments(bodies, plan, 1);
  for (const std::uint32_t count : counts) {
    Players players(random, count, static_cast<std::uint32_t>(bodies.size()));
    moments.show(players.body, players.seconds, players.shape);
    const OwnShapes expect(shapes, players, plan);
    for (std::uint32_t i = 0; i < count; ++i)
      EXPECT_EQ(moments.set().discs(players.shape[i], 0), expect.set.discs(i, 0));
    const std::vector<Pair> pairs = test::candidate_pairs(expect.set, expect.agents, 1);
    if (plan.depths.size() > 1) {  // where there are leaves alone, candidates may be more
      EXPECT_TRUE(test::candidate_pairs(moments.set(), players.agents()) ==
                  test::candidate_pairs(expect.set, expect.agents));
    }
    const AllAnswers found(moments.set(), players.agents(), pairs, walls),
        expected(expect.set, expect.agents, pairs, walls);
    EXPECT_TRUE(found == expected);
    if (count < 60) continue;
    EXPECT_GT(std::count(found.hits.begin(), found.hits.end(), 1), 10);
    EXPECT_GT(std::count(found.at_walls.begin(), found.at_walls.end(), 1), 0);
    EXPECT_GT(std::ssize(found.contacts), 10);
    for (const Finding& finding : verify(moments.set(), 1000))
      EXPECT_EQ(finding.what.find("does not hold the discs"), std::string::npos) << text_of(finding);
  }
}

TEST_F(Moments, AnswerAsTheShapesOfTheirTimes) {
  Random random(3122);
  for (const bool culling : {false, true})
    expect_own_shapes(random, shapes, {.depths = {0, 3, all_depths}, .culling = culling},
                      {40, 7, 90, 300, 120, 300});
}

/// Bodies that are cut beside one that is whole.
TEST_F(Moments, OfSlabsAnswerAsTheShapesOfTheirTimes) {
  Random random(3128);
  const ShapeSetPlan plan{.slices = {0.5f, 1}};
  shapes.erase(shapes.begin() + 1, shapes.end());
  for (int i = 0; i < 3; ++i) shapes.emplace_back(test::sliced_body(random, plan.slices));
  EXPECT_EQ(test::complaint([&] { MomentSet whole(pointers(shapes)); }),
            "moments: body 1 is cut at other planes");
  expect_own_shapes(random, shapes, plan, {20, 60, 60});
}

/// The level of all depths alone, without culling data, is there but for its discs.
TEST_F(Moments, OfLeavesAloneAnswerAsTheShapesOfTheirTimes) {
  Random random(3129);
  shapes.emplace_back(test::loose_discs(random, 1));
  for (const std::uint32_t discs : {3u, 8u, 9u, 200u}) shapes.emplace_back(test::loose_discs(random, discs));
  shapes.emplace_back(test::ringed_body(random, 2, 700));
  for (const bool outlines : {false, true})
    expect_own_shapes(random, shapes, {.outlines = outlines, .culling = false, .heights = true},
                      {60, 250, 90});
}

TEST_F(Moments, LoopsAreTheSameInEachRound) {
  const AnimatedChunk standing{{0, 1, 2}, 1, {{0, 0, 1}, {0.5f, 0, 1}, {0, 0, 1}}, {}};
  const AnimatedShape loop({{standing}, true}), once({{standing}, false});
  const AnimatedShape* const both[] = {&loop, &once};
  MomentSet moments(both);
  const std::vector<std::uint32_t> body = {0, 0, 0, 1, 1, 1};
  const std::vector<double> seconds = {0.5, 2.5, -1.5, 2.5, 7, -1};
  std::vector<std::uint32_t> shape(body.size());
  moments.show(body, seconds, shape);
  EXPECT_EQ(shape[0], shape[1]);
  EXPECT_EQ(shape[0], shape[2]);
  EXPECT_EQ(shape[3], shape[4]);
  EXPECT_NE(shape[3], shape[5]);
  const auto x_of = [&](std::uint32_t which) { return moments.set().discs(which, 0).front().x; };
  EXPECT_EQ(x_of(shape[0]), 0.25f);
  EXPECT_EQ(x_of(shape[3]), 0.0f);
}

/// A character's clip has heights, as its poses do.
TEST_F(Moments, OnOtherFloorsDoNotMeet) {
  Character man = test::default_characters()[0];
  man.clips.resize(1);
  man.clips[0].seconds = 0.1f;
  const AnimatedShape whole(animate(man, 0));
  const AnimatedShape* const only[] = {&whole};
  MomentSet moments(only, {.heights = true});
  const std::vector<std::uint32_t> body = {0, 0};
  const std::vector<double> seconds = {0.05, 0.07}, x = {0, 0.1}, y = {0, 0}, heading = {0, 0};
  std::vector<std::uint32_t> shape(2);
  moments.show(body, seconds, shape);
  for (const double floor : {0.0, 1.0, 3.0, -3.0}) {
    const std::vector<double> z = {0, floor};
    std::uint8_t hit = 7;
    collide(moments.set(), Agents{shape, x, y, heading, {}, z}, std::vector<Pair>{{0, 1}}, {&hit, 1});
    EXPECT_EQ(hit, std::abs(floor) < 2) << floor;
  }
}

}  // namespace
}  // namespace bch
