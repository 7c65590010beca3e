// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

// Clips that loop for a very long time: first contacts end, or are refused.

#include "tests/support/moving_bodies.hpp"
#include "tests/support/obstacle_scenes.hpp"
#include "tests/support/test.hpp"

namespace bch {
namespace {

using test::contact_of;
using test::MotionCase;

constexpr double never = std::numeric_limits<double>::infinity();
constexpr TimeInterval all_times{-1e6, 1e6};

/// Returns a disc of 0.25 m that goes ahead by a way and back again in each round of some seconds.
AnimatedDiscs pendulum(double seconds, float way, bool loops = true) {
  const Disc rest{0, 0, 0.25f}, ahead{way, 0, 0.25f};
  return {{{{0, seconds / 2, seconds}, 1, {rest, ahead, rest}}}, loops};
}

MotionCase standing(AnimatedDiscs body, double x, double y, double begin = 0) {
  return {std::move(body), {{0, x, y, 0}}, begin};
}

ObstacleSet wall(double ax, double ay, double bx, double by) {
  const std::vector<double> x = {ax, bx}, y = {ay, by};
  const std::vector<std::uint64_t> paths = {0, 2};
  return ObstacleSet({x, y, paths});
}

/// Two billion rounds within reach of each other are not gone through one by one: this would take an hour.
TEST(LongLoops, OfWhoStandsAreSeenAfterARound) {
  const ObstacleSet beside = wall(-1, 0.4, 1, 0.4);
  for (int k = 0; k < 10; ++k) {
    const MotionCase body = standing(pendulum(0.001, 0.25f), 0, 0),
                     same = standing(pendulum(0.001, 0.25f), 0, 0.6, k),
                     still = standing(pendulum(2, 0, false), 0, 0.6, k);
    EXPECT_EQ(contact_of(body, same, all_times), never);
    EXPECT_EQ(contact_of(body, still, {k + 2.0, 1e6}), never);
    EXPECT_EQ(contact_of(body, beside, all_times), never);
  }
}

/// What happens in a round is seen in the first one, whenever that begins.
TEST(LongLoops, TouchInTheirFirstRound) {
  const MotionCase body = standing(pendulum(2, 0.25f), 0, 0),
                   still = standing(pendulum(1, 0, false), 0.625, 0),
                   against = standing(pendulum(2, -0.25f), 0.76, 0, 1);
  const ObstacleSet ahead = wall(0.375, -1, 0.375, 1);
  for (const double from : {-8.0, -6.3, 0.0, 0.3, 6.0, 1e5}) {
    // 0.125 m ahead after half a second of each round.
    const double expected = 2 * std::ceil((from - 0.5) / 2) + 0.5;
    EXPECT_NEAR(contact_of(body, still, {from, 2e5}), expected, 0.025) << from;
    EXPECT_NEAR(contact_of(body, ahead, {from, 2e5}), expected, 0.025) << from;
    EXPECT_EQ(contact_of(body, against, {from, 2e5}), never) << from;
  }
}

// Sanitizers take a minute for 1e8 steps.
#ifndef BCH_SANITIZED

void expect_too_long(const std::string& said, const std::string& who) {
  EXPECT_EQ(said.find(who + ": more than 1e8 steps, "), 0u) << said;
}

/// One who walks along a fence for long is refused, and nothing is written.
TEST(LongLoops, AlongAFenceAreRefused) {
  test::ObstacleScene fence;
  for (int i = 0; i < 2'000; ++i) fence.add_path({{-0.35, -1 + 0.001 * i}, {-0.3, -1 + 0.001 * i}}, false);
  fence.end_obstacle(false);
  const MotionCase walks{pendulum(0.001, 0.125f), {{0, 0, -0.5, 0}, {1000, 0, 0.5, 0}}};
  double time = 7;
  const auto contact = [&](double seconds) {
    first_contact(std::vector<Motion>{walks.motion()}, fence.set(), {0, seconds}, {&time, 1});
  };
  expect_too_long(test::complaint([&] { contact(1000); }), "first_contact: motion 0");
  EXPECT_EQ(time, 7);
  contact(0.5);
  EXPECT_EQ(time, never);
}

/// So is one who walks a million kilometres along walls, in steps of a body's size.
TEST(LongLoops, AlongWallsWithoutEndAreRefused) {
  test::ObstacleScene walls;
  for (int i = 0; i < 300; ++i) walls.add_path({{-1e9, -0.004}, {1e9, -0.004}}, false);
  walls.end_obstacle(false);
  const MotionCase walks{pendulum(1, 0.01f), {{0, -5e8, 0.255, 0}, {1e6, 5e8, 0.255, 0}}};
  expect_too_long(test::complaint([&] {
                    contact_of(walks, walls.set(), {0, 1e6});
                  }),
                  "first_contact: motion 0");
}

/// So are two who do not repeat themselves together.
TEST(LongLoops, OfDifferentLengthsAreRefused) {
  const MotionCase a = standing(pendulum(0.001, 0.125f), 0, 0),
                   b = standing(pendulum(0.0011, 0.125f), 0, 0.55);
  EXPECT_EQ(contact_of(a, b, {0, 20}), never);
  const std::vector<Motion> motions = {a.motion(), b.motion()};
  const std::vector<Pair> pairs = {{0, 1}};
  double time = 7;
  expect_too_long(test::complaint([&] {
                    first_contact(motions, pairs, all_times, {&time, 1});
                  }),
                  "first_contact: pair 0");
  EXPECT_EQ(time, 7);
}

#endif

}  // namespace
}  // namespace bch
