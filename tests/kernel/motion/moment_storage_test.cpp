// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <oneapi/tbb/task_arena.h>

#include "tests/support/allocation_count.hpp"
#include "tests/support/crowd_pairs.hpp"
#include "tests/support/moments.hpp"
#include "tests/support/moving_bodies.hpp"
#include "tests/support/test.hpp"
#include "tests/support/test_characters.hpp"

// When the shapes of moments are made, how long they are kept, and which are refused.

namespace bch {
namespace {

using test::distances;
using test::Moments;
using test::Players;
using test::Random;

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
      const std::vector<Pair> pairs = test::candidate_pairs(moments.set(), players.agents());
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
  const std::vector<Pair> pairs = test::candidate_pairs(expected.set(), players.agents());
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
