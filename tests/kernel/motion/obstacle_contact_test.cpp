// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/moving_bodies.hpp"
#include "tests/support/obstacle_scenes.hpp"
#include "tests/support/plane_geometry.hpp"
#include "tests/support/test.hpp"

// The first contact of a motion with obstacles, against its solid sampled densely and compared with every segment.

namespace bch {
namespace {

using baselines::ReferenceObstacle;
using test::contact_of;
using test::MotionCase;
using test::ObstacleScene;
using test::Random;
using test::still_disc;

using test::never;

/// The gap of the nearest disc and segment, and whether an area holds a disc's centre.
struct Meeting {
  double gap = never;
  bool inside = false;
  bool overlap() const { return gap <= 0 || inside; }
};

Meeting meeting_at(const MotionCase& motion, const ObstacleScene& scene, double time) {
  Meeting meeting;
  for (const ReferenceObstacle& obstacle : scene.reference) {
    for (const test::WorldDisc& disc : test::placed_at(motion, time)) {
      for (const auto& [ax, ay, bx, by] : obstacle.segments)
        meeting.gap =
            std::min(meeting.gap, test::distance_to_segment(disc.x, disc.y, ax, ay, bx, by) - disc.radius);
      meeting.inside |= obstacle.is_area && test::contains(obstacle, disc.x, disc.y);
    }
  }
  return meeting;
}

TEST(ObstacleContact, IsNeverLaterThanAnySampleAndEarlyByTheToleranceAtMost) {
  Random random(3171);
  int contacts = 0, passes = 0, inside = 0;
  for (std::uint32_t i = 0; i < test::samples(300); ++i) {
    const MotionCase motion = test::random_motion(random);
    ObstacleScene scene = test::obstacle_scene(random, 1 + random.below(2), 1.5);
    const double where = random.uniform(-0.2, 0.2), x = motion.path[0].x + where, y = motion.path[0].y;
    if (i % 8 == 0) scene.add({{x, y}}, false);
    if (i % 8 == 1) scene.add({{x - 1, y - 1}, {x + 1, y - 1}, {x + 1, y + 1}, {x - 1, y + 1}}, true);
    const ObstacleSet obstacles = scene.set();
    const double tolerance = std::exp(random.uniform(-9, -3)), from = random.uniform(-2, 0.5), to = 3,
                 found = contact_of(motion, obstacles, {from, to}, tolerance);
    for (double time = from; time < std::min(found, to); time += 0.002)
      ASSERT_FALSE(meeting_at(motion, scene, time).overlap()) << i << ": at " << time << ", found " << found;
    ++(found < never ? contacts : passes);
    if (found == never) continue;
    EXPECT_EQ(contact_of(motion, obstacles, {from, 30}, tolerance), found) << i;
    for (int k = 1; k <= 50 && found - 1e-5 * k >= from; ++k)
      ASSERT_FALSE(meeting_at(motion, scene, found - 1e-5 * k).overlap()) << i << ": " << k;
    const Meeting meeting = meeting_at(motion, scene, found),
                  behind = meeting_at(motion, scene, found + 1e-9);
    inside += std::min(meeting.gap, behind.gap) > tolerance;
    EXPECT_TRUE(meeting.inside || behind.inside || std::min(meeting.gap, behind.gap) <= tolerance + 2e-5)
        << i << ": gaps of " << meeting.gap << " and " << behind.gap << " at " << found;
  }
  EXPECT_GT(contacts, static_cast<int>(test::samples(120)));
  EXPECT_GT(passes, static_cast<int>(test::samples(40)));
  EXPECT_GT(inside, 0);
}

ObstacleScene scene_of(const std::vector<ObstacleScene::Point>& path, bool is_area) {
  ObstacleScene scene;
  scene.add(path, is_area);
  return scene;
}

/// A disc stands 0.1 m beside a wall, and jumps away or through it.
TEST(ObstacleContact, OfAJumpIsOnItsWay) {
  const ObstacleScene wall = scene_of({{-0.35, -5}, {-0.35, 5}}, false);
  for (const double seconds : {1e-3, 1e-6, 1e-9}) {
    const double back = 5 + seconds;
    const auto to = [&](double x) {
      return MotionCase{still_disc(0.25f), {{0, 0, 0, 0}, {5, 0, 0, 0}, {back, x, 0, 0}}};
    };
    EXPECT_EQ(contact_of(to(100), wall.set(), {0, 10}), never) << seconds;
    const double found = contact_of(to(-100), wall.set(), {0, 10});
    EXPECT_GE(found, 5) << seconds;
    EXPECT_LE(found, back) << seconds;
  }
}

/// A disc of 3/16 m comes along x at 1.5 m a second from 30 m away, also from far away and past the end of a wall.
TEST(ObstacleContact, OfADiscIsThatOfTheFormula) {
  constexpr double radius = 0.1875;
  for (const double far : {0.0, 1e7}) {
    const MotionCase comes{still_disc(0.1875f), {{0, far - 30, far, 0}, {40, far + 30, far, 0}}};
    const double rounding = far == 0 ? 2e-6 : 2e-5;
    const auto expect = [&](const ObstacleScene& scene, double expected) {
      const double found = contact_of(comes, scene.set(), {0, 40});
      EXPECT_LE(found, expected);
      EXPECT_NEAR(found, expected, rounding);
      EXPECT_EQ(contact_of(comes, scene.set(), {0, expected - 0.01}), never);
      EXPECT_EQ(contact_of(comes, scene.set(), {expected + 0.01, expected + 0.02}), expected + 0.01);
    };
    expect(scene_of({{far, far - 5}, {far, far + 5}}, false), (30 - radius) / 1.5);
    expect(scene_of({{far - 5, far - 10}, {far + 5, far + 10}}, false),
           (30 - radius * std::sqrt(1.25)) / 1.5);
    expect(scene_of({{far, far + 0.1}, {far + 9, far + 0.1}}, false),
           (30 - std::sqrt(radius * radius - 0.01)) / 1.5);
    expect(scene_of({{far, far + 0.1}}, false), (30 - std::sqrt(radius * radius - 0.01)) / 1.5);
    EXPECT_EQ(contact_of(comes, scene_of({{far, far + 0.2}, {far, far + 9}}, false).set(), {0, 40}), never);
    // Inside a large area, and beside one that begins where another one would end by the even-odd rule.
    const ObstacleScene area = scene_of(
        {{far - 1000, far - 50}, {far + 1000, far - 50}, {far + 1000, far + 50}, {far - 1000, far + 50}},
        true);
    EXPECT_EQ(contact_of(comes, area.set(), {3, 40}), 3);
    const ObstacleScene beside = scene_of(
        {{far - 1000, far + 1}, {far + 1000, far + 1}, {far + 1000, far + 50}, {far - 1000, far + 50}}, true);
    EXPECT_EQ(contact_of(comes, beside.set(), {3, 40}), never);
  }
}

/// A body that goes through the side of an area from one chunk to the next.
TEST(ObstacleContact, SeesWhoIsInsideWhereAChunkBegins) {
  const auto at = [](double begin, double end, float x) {
    return AnimatedChunk{{begin, end}, 1, {{x, 0, 0.125f}, {x, 0, 0.125f}}};
  };
  AnimatedDiscs jumps;
  jumps.chunks = {at(0, 1, -1), at(1, 2, 1)};
  const MotionCase over{jumps, {{0, 0, 0, 0}}};
  const ObstacleScene area = scene_of({{0, -9}, {9, -9}, {9, 9}, {0, 9}}, true);
  EXPECT_EQ(contact_of(over, area.set(), {0, 2}), 1);
  EXPECT_EQ(contact_of(over, area.set(), {0, 0.5}), never);
}

TEST(ObstacleContact, IsThatOfBothWithOthersAndRefusesWhatIsNoMotion) {
  const MotionCase comes{still_disc(0.125f), {{0, 0, 0, 0}, {10, 10, 0, 0}}},
      stands{still_disc(0.125f), {{0, 5, 0, 0}}};
  const ObstacleScene near = scene_of({{4, -1}, {4, 1}}, false), far = scene_of({{8, -1}, {8, 1}}, false);
  const std::vector<Motion> others = {stands.motion()};
  EXPECT_NEAR(free_until(comes.motion(), others, near.set(), {0, 10}), 3.875, 1e-5);
  EXPECT_NEAR(free_until(comes.motion(), others, far.set(), {0, 10}), 4.75, 1e-5);
  EXPECT_NEAR(free_until(comes.motion(), {}, far.set(), {0, 10}), 7.875, 1e-5);
  EXPECT_EQ(free_until(comes.motion(), {}, far.set(), {0, 7}), never);
  std::vector<double> times(1);
  EXPECT_EQ(test::complaint([&] {
              first_contact(std::vector<Motion>{{nullptr, comes.path, 0}}, near.set(), {0, 1}, times);
            }),
            "first_contact: motion 0: expected a shape, found none");
  EXPECT_NE(test::complaint([&] { first_contact({}, near.set(), {0, 1}, times); }), "accepted");
}

// ---- Clips that loop for a very long time: first contacts end, or are refused.

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
  return scene_of({{ax, ay}, {bx, by}}, false).set();
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
  for (int i = 0; i < 2'000; ++i)
    fence.add_polyline({{-0.35, -1 + 0.001 * i}, {-0.3, -1 + 0.001 * i}}, false);
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
  for (int i = 0; i < 300; ++i) walls.add_polyline({{-1e9, -0.004}, {1e9, -0.004}}, false);
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
