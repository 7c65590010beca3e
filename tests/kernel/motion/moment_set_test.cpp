// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include <bch/broad_phase.hpp>
#include <bch/clearance.hpp>
#include <bch/collide.hpp>
#include <bch/contacts.hpp>
#include <bch/obstacles.hpp>
#include <bch/penetration.hpp>
#include <bch/pose_shape.hpp>
#include <bch/time_of_impact.hpp>
#include <bch/verify.hpp>

#include "tests/support/allocation_count.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/moving_bodies.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/test_characters.hpp"

// Agents who show bodies that move by themselves, each at a time of its own.

namespace bch {
namespace {

using test::Random;

/// Bodies of many discs and of few, with rings, which loop and which do not.
class Moments : public testing::Test {
 protected:
  Moments() {
    Random random(3121);
    for (std::uint32_t i = 0; i < 5; ++i)
      shapes.emplace_back(test::ringed_body(random, 1 + i % 2, 10 + 12 * i));
    for (const AnimatedShape& shape : shapes) bodies.push_back(&shape);
  }

  std::vector<AnimatedShape> shapes;
  std::vector<const AnimatedShape*> bodies;
};

/// A crowd whose agents show bodies at times.
struct Players {
  std::vector<std::uint32_t> body, shape;
  std::vector<double> seconds, x, y, heading;

  Players(Random& random, std::uint32_t count, std::uint32_t of) : shape(count) {
    const double side = std::sqrt(count / 4.0);
    for (std::uint32_t i = 0; i < count; ++i) {
      body.push_back(random.below(of));
      seconds.push_back(random.uniform(-3, 3));
      x.push_back(random.uniform(0, side));
      y.push_back(random.uniform(0, side));
      heading.push_back(random.uniform(-4, 4));
    }
  }
  Agents agents() const { return {shape, x, y, heading}; }
};

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

std::vector<float> distances(const ShapeSet& set, const Agents& agents, std::span<const Pair> pairs) {
  std::vector<float> found(pairs.size());
  clearance(set, agents, pairs, {found, {}, {}, {}});
  return found;
}

/// Bodies that are cut beside one that is whole.
TEST_F(Moments, OfSlabsAnswerAsTheShapesOfTheirTimes) {
  Random random(3128);
  const ShapeSetPlan plan{.slices = {0.5f, 1}};
  shapes.erase(shapes.begin() + 1, shapes.end());
  for (int i = 0; i < 3; ++i) shapes.emplace_back(test::sliced_body(random, plan.slices));
  bodies.clear();
  for (const AnimatedShape& shape : shapes) bodies.push_back(&shape);
  EXPECT_EQ(test::complaint([&] { MomentSet whole(bodies); }), "moments: body 1 is cut at other planes");
  MomentSet moments(bodies, plan);
  std::size_t hits = 0;
  for (const std::uint32_t count : {20u, 60u, 60u}) {
    Players players(random, count, static_cast<std::uint32_t>(bodies.size()));
    moments.show(players.body, players.seconds, players.shape);
    const OwnShapes expect(shapes, players, plan);
    const std::vector<Pair> pairs = candidate_pairs(moments.set(), players.agents());
    std::vector<std::uint8_t> found(pairs.size()), expected(pairs.size());
    collide(moments.set(), players.agents(), pairs, found);
    collide(expect.set, expect.agents, pairs, expected);
    EXPECT_EQ(found, expected);
    hits += static_cast<std::size_t>(std::count(found.begin(), found.end(), 1));
  }
  EXPECT_GT(hits, 10u);
}

/// Answers are those of a set that has the shape of each agent, however many there are from call to call.
TEST_F(Moments, AnswerAsTheShapesOfTheirTimes) {
  Random random(3122);
  for (const bool culling : {false, true}) {
    const ShapeSetPlan plan{.depths = {0, 3, all_depths}, .culling = culling};
    MomentSet moments(bodies, plan, 1);
    int hits = 0;
    for (const std::uint32_t count : {40u, 7u, 90u, 300u, 120u, 300u}) {
      Players players(random, count, static_cast<std::uint32_t>(bodies.size()));
      moments.show(players.body, players.seconds, players.shape);
      const OwnShapes expect(shapes, players, plan);
      const std::vector<Pair> pairs = candidate_pairs(moments.set(), players.agents());
      EXPECT_EQ(pairs, candidate_pairs(expect.set, expect.agents));
      for (const Semantics semantics : {Semantics::boundary, Semantics::solid}) {
        std::vector<std::uint8_t> found(pairs.size()), expected(pairs.size());
        collide(moments.set(), players.agents(), pairs, found, {.semantics = semantics});
        collide(expect.set, expect.agents, pairs, expected, {.semantics = semantics});
        EXPECT_EQ(found, expected);
        hits += static_cast<int>(std::count(found.begin(), found.end(), 1));
      }
      EXPECT_EQ(distances(moments.set(), players.agents(), pairs),
                distances(expect.set, expect.agents, pairs));
    }
    EXPECT_GT(hits, 100);
  }
}

/// Everything that a query can tell of pairs and of agents near obstacles, at the level of all depths.
struct AllAnswers {
  std::vector<std::uint8_t> hits, near, solid, at_walls;
  std::vector<float> distance, time, to_walls;
  std::vector<Penetration> depth;
  std::vector<DiscPair> contacts;
  std::vector<std::uint64_t> offsets;
  friend bool operator==(const AllAnswers&, const AllAnswers&) = default;

  AllAnswers(const ShapeSet& set, const Agents& agents, std::span<const Pair> pairs, const ObstacleSet& walls)
      : hits(pairs.size()),
        near(pairs.size()),
        solid(set.solid() ? pairs.size() : 0),
        at_walls(agents.shape.size()),
        distance(distances(set, agents, pairs)),
        time(pairs.size()),
        to_walls(agents.shape.size()),
        depth(pairs.size()) {
    collide(set, agents, pairs, hits);
    if (set.solid()) collide(set, agents, pairs, solid, {.semantics = Semantics::solid});
    const double within_metres[] = {0.125};
    within(set, agents, pairs, within_metres, near);
    const std::vector<double> way(pairs.size(), 0.5), back(pairs.size(), -0.25);
    time_of_impact(set, agents, pairs, {way, back}, time);
    penetration(set, agents, pairs, 8, depth);
    ContactFinder finder;
    const Rows<DiscPair> found = finder.find(set, agents, pairs);
    contacts.assign(found.values.begin(), found.values.end());
    offsets.assign(found.offsets.begin(), found.offsets.end());
    collide(set, agents, walls, at_walls);
    clearance(set, agents, walls, {to_walls, {}, {}, {}});
  }
};

/// The level of all depths alone, without culling data, is there but for its discs.
TEST_F(Moments, OfLeavesAloneAnswerEveryQueryAsTheShapesOfTheirTimes) {
  Random random(3129);
  shapes.emplace_back(test::loose_discs(random, 1));
  for (const std::uint32_t discs : {3u, 8u, 9u, 200u}) shapes.emplace_back(test::loose_discs(random, discs));
  shapes.emplace_back(test::ringed_body(random, 2, 700));
  bodies.clear();
  for (const AnimatedShape& shape : shapes) bodies.push_back(&shape);
  const ObstacleSet walls = obstacles_from_wkt("LINESTRING (0 0, 4 5, 3 6) POLYGON ((6 6, 7 6, 7 7, 6 6))");
  for (const bool outlines : {false, true}) {
    const ShapeSetPlan plan{.outlines = outlines, .culling = false, .heights = true};
    MomentSet moments(bodies, plan, 1);
    for (const std::uint32_t count : {60u, 250u, 90u}) {
      Players players(random, count, static_cast<std::uint32_t>(bodies.size()));
      moments.show(players.body, players.seconds, players.shape);
      const OwnShapes expect(shapes, players, plan);
      for (std::uint32_t i = 0; i < count; ++i) {
        const std::vector<Disc> discs = moments.set().discs(players.shape[i], 0);
        EXPECT_EQ(discs, expect.set.discs(i, 0));
      }
      const std::vector<Pair> pairs = candidate_pairs(expect.set, expect.agents, 1);
      const AllAnswers found(moments.set(), players.agents(), pairs, walls),
          expected(expect.set, expect.agents, pairs, walls);
      EXPECT_TRUE(found == expected);
      EXPECT_GT(std::count(found.hits.begin(), found.hits.end(), 1), 20);
      EXPECT_GT(std::count(found.at_walls.begin(), found.at_walls.end(), 1), 0);
      EXPECT_GT(std::ssize(found.contacts), 100);
      for (const Finding& finding : verify(moments.set(), 1000))
        EXPECT_EQ(finding.what.find("does not hold the discs"), std::string::npos) << text_of(finding);
    }
  }
}

TEST_F(Moments, AreMadeOnce) {
  MomentSet moments(bodies, {}, 1);
  const double length = shapes[0].end() - shapes[0].begin(), at = shapes[0].begin() + 0.25 * length;
  // The same time, beyond the ends of a clip, in another round.
  const std::vector<std::uint32_t> body = {0, 1, 0, 0, 1, 2, 2, 0};
  std::vector<double> seconds = {at, at, at, at + 0.25 * length, at, -100, -200, -0.0};
  if (shapes[2].loops()) seconds[5] = seconds[6];
  std::vector<std::uint32_t> shape(body.size());
  moments.show(body, seconds, shape);
  EXPECT_EQ(shape[0], shape[2]);
  EXPECT_EQ(shape[1], shape[4]);
  EXPECT_EQ(shape[5], shape[6]);
  EXPECT_EQ(std::set(shape.begin(), shape.end()).size(), 5u);
  EXPECT_EQ(moments.set().shape_count(), 5u);
  // What is there stays where it is, as long as there is room.
  std::vector<std::uint32_t> again(body.size());
  moments.show(body, seconds, again);
  EXPECT_EQ(again, shape);
  const std::vector<double> later(body.size(), at + 0.3 * length);
  moments.show(body, later, again);
  EXPECT_EQ(moments.set().shape_count(), 5u);
}

TEST_F(Moments, AreKeptForLaterCalls) {
  MomentSet moments(bodies, {}, 9);
  const std::vector<std::uint32_t> body = {0, 1, 2};
  const std::vector<double> early = {0.1, 0.1, 0.1}, late = {0.2, 0.2, 0.2};
  std::vector<std::uint32_t> first(3), second(3), again(3);
  moments.show(body, early, first);
  moments.show(body, late, second);
  moments.show(body, early, again);
  EXPECT_EQ(again, first);
  EXPECT_EQ(moments.set().shape_count(), 9u);
  EXPECT_NE(second, first);
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

/// With culling data and outlines, or leaves alone, which are made another way.
class MomentsOfPlans : public Moments, public testing::WithParamInterface<bool> {
 protected:
  const ShapeSetPlan plan{.outlines = GetParam(), .culling = GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Plans, MomentsOfPlans, testing::Bool(),
                         [](const auto& whole) { return whole.param ? "Whole" : "LeavesAlone"; });

TEST_P(MomentsOfPlans, AreTheSameForAnyNumberOfThreads) {
  Random random(3123);
  Players players(random, 400, static_cast<std::uint32_t>(bodies.size()));
  std::vector<std::vector<std::uint32_t>> shape;
  std::vector<std::vector<std::uint8_t>> hits;
  for (const int threads : {1, 2, 5}) {
    tbb::task_arena(threads).execute([&] {
      MomentSet moments(bodies, plan);
      moments.show(players.body, players.seconds, players.shape);
      const std::vector<Pair> pairs = candidate_pairs(moments.set(), players.agents());
      hits.emplace_back(pairs.size());
      collide(moments.set(), players.agents(), pairs, hits.back());
      shape.push_back(players.shape);
    });
    EXPECT_EQ(shape.back(), shape.front());
    EXPECT_EQ(hits.back(), hits.front());
  }
}

TEST_P(MomentsOfPlans, KeepTheirMemory) {
  Random random(3124);
  MomentSet moments(bodies, plan, 1);
  tbb::task_arena(1).execute([&] {
    Players players(random, 100, static_cast<std::uint32_t>(bodies.size()));
    const auto show = [&] {
      for (double& seconds : players.seconds) seconds += 0.013;
      moments.show(players.body, players.seconds, players.shape);
    };
    for (int i = 0; i < 150; ++i) show();
    const std::size_t before = test::allocation_count();
    for (int i = 0; i < 20; ++i) show();
    EXPECT_EQ(test::allocation_count() - before, 0u);
  });
}

/// Where memory runs out, the next call makes what is missing.
TEST_P(MomentsOfPlans, OutliveAFailedAllocation) {
  Random random(3125);
  Players players(random, 60, static_cast<std::uint32_t>(bodies.size()));
  MomentSet expected(bodies, plan);
  expected.show(players.body, players.seconds, players.shape);
  const std::vector<Pair> pairs = candidate_pairs(expected.set(), players.agents());
  const std::vector<float> distance = distances(expected.set(), players.agents(), pairs);
  std::size_t failed = 1;
  for (std::size_t after = 0; failed > 0; after += 7) {
    MomentSet moments(bodies, plan, 1);
    test::fail_allocations(test::Failing::one, after);
    try {
      moments.show(players.body, players.seconds, players.shape);
    } catch (const std::bad_alloc&) {
    }
    failed = test::stop_failing_allocations();
    moments.show(players.body, players.seconds, players.shape);
    EXPECT_EQ(distances(moments.set(), players.agents(), pairs), distance) << after;
  }
}

TEST_F(Moments, NameWhatIsWrong) {
  const auto made = [&](std::vector<const AnimatedShape*> of) {
    return test::complaint([&] { MomentSet moments(of); });
  };
  EXPECT_EQ(made(bodies), "accepted");
  EXPECT_EQ(made({}), "moments: no bodies");
  EXPECT_EQ(made({bodies[0], nullptr}), "moments: body 1 is missing");
  MomentSet moments(bodies);
  const auto shown = [&](std::vector<std::uint32_t> body, std::vector<double> seconds, std::size_t count) {
    std::vector<std::uint32_t> shape(count, 77);
    const std::string said = test::complaint([&] { moments.show(body, seconds, shape); });
    EXPECT_TRUE(said == "accepted" || std::count(shape.begin(), shape.end(), 77u) == std::ssize(shape));
    return said;
  };
  EXPECT_EQ(shown({0, 4}, {1, 1e6}, 2), "accepted");
  EXPECT_EQ(shown({}, {}, 0), "accepted");
  EXPECT_EQ(shown({0, 5}, {1, 1}, 2), "moments: agent 1: body 5 of 5");
  EXPECT_EQ(shown({0, 0}, {1, 1.1e6}, 2), "moments: agent 1: at 1100000 s, not within +-1e6");
  EXPECT_EQ(shown({0}, {std::numeric_limits<double>::quiet_NaN()}, 1),
            "moments: agent 0: at nan s, not within +-1e6");
  EXPECT_NE(shown({0, 0}, {1}, 2), "accepted");
  EXPECT_NE(shown({0, 0}, {1, 1}, 3), "accepted");
}

}  // namespace
}  // namespace bch
