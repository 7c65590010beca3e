// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/moving_bodies.hpp"
#include "tests/support/on_threads.hpp"
#include "tests/support/test.hpp"

// The first contact of two motions, against the solids sampled densely, and where a formula tells it.

namespace bch {
namespace {

using test::contact_of;
using test::MotionCase;
using test::Random;
using test::still_disc;

using test::never;

MotionCase disc_on(float radius, std::vector<PathKey> path) {
  return {still_disc(radius), std::move(path)};
}

/// Finds the first contact, and compares it with samples of the motions.
void expect_first_contact(const MotionCase& a, const MotionCase& b, TimeInterval when, double tolerance,
                          double& found) {
  found = contact_of(a, b, when, tolerance);
  for (double time = when.from; time < std::min(found, when.to); time += 0.001)
    ASSERT_FALSE(test::gap_at(a, b, time) <= 0) << "at " << time << ", found " << found;
  if (found == never) return;
  for (int k = 1; k <= 100 && found - 1e-5 * k >= when.from; ++k)
    ASSERT_FALSE(test::gap_at(a, b, found - 1e-5 * k) <= 0) << k << " before " << found;
  // Just behind, too: a chunk may begin there.
  const double gap = test::gap_at(a, b, found), behind = test::gap_at(a, b, found + 1e-9);
  EXPECT_LE(std::min(gap, behind), tolerance + 2e-5)
      << "gaps of " << gap << " and " << behind << " at " << found;
}

/// Returns a random motion of spheres of about the height of a person, whose path goes up and down.
MotionCase random_motion_in_space(Random& random) {
  MotionCase flat = test::random_motion(random);
  for (PathKey& key : flat.path) key.z = random.uniform(-0.5, 0.5);
  return {test::in_space(random, std::move(flat.discs), random.uniform(0.1, 1.8)), std::move(flat.path),
          flat.clip_begin};
}

/// Two bodies of discs; two of spheres, or one of them and one of discs.
TEST(FirstContact, IsNeverLaterThanAnySampleAndEarlyByTheToleranceAtMost) {
  Random random(3101);
  for (const bool in_space : {false, true}) {
    int contacts = 0, passes = 0, fewer = 0;
    for (std::uint32_t i = 0; i < test::samples(2100); ++i) {
      SCOPED_TRACE(i);
      const MotionCase a = in_space ? random_motion_in_space(random) : test::random_motion(random),
                       b = in_space && i % 4 != 0 ? random_motion_in_space(random)
                                                  : test::random_motion(random);
      const double tolerance = std::exp(random.uniform(-9, -3));
      double found = 0;
      ASSERT_NO_FATAL_FAILURE(expect_first_contact(a, b, {-2, 3}, tolerance, found));
      ++(found < never ? contacts : passes);
      if (!in_space) continue;
      AnimatedDiscs flat = a.discs;
      for (AnimatedChunk& chunk : flat.chunks) chunk.z.clear();
      const double from_above = contact_of({std::move(flat), a.path, a.clip_begin}, b, {-2, 3}, tolerance);
      fewer += from_above < never && found == never;
    }
    EXPECT_GT(contacts, static_cast<int>(test::samples(500)));
    EXPECT_GT(passes, static_cast<int>(test::samples(250)));
    EXPECT_TRUE(!in_space || fewer > static_cast<int>(test::samples(100)));
  }
}

/// A sphere that comes over one that stands, or falls onto it from far above.
TEST(FirstContact, OfTwoSpheresIsThatOfTheFormula) {
  const auto sphere = [](float radius, float z) {
    AnimatedDiscs body = still_disc(radius);
    body.chunks[0].z = {z, z};
    return body;
  };
  const MotionCase stands{sphere(0.1875f, 1), {{0, 0, 0, 1}}};
  for (const double above : {0.0, 0.3, 0.49, 0.499999}) {
    const MotionCase comes{sphere(0.3125f, 0.5f), {{0, -10, 0, 0, 0.5 + above}, {10, 10, 0, 0, 0.5 + above}}};
    const double expected = 5 - std::sqrt(0.25 - above * above) / 2;
    EXPECT_NEAR(contact_of(stands, comes, {0, 10}), expected, above < 0.49 ? 4e-6 : 2e-3) << above;
    EXPECT_LE(contact_of(stands, comes, {0, 10}), expected) << above;
  }
  EXPECT_EQ(contact_of(stands, {sphere(0.3125f, 0.5f), {{0, -10, 0, 0, 1.1}, {10, 10, 0, 0, 1.1}}}, {0, 10}),
            never);
  for (const double height : {2.0, 1000.0, 1e6}) {
    const MotionCase falls{sphere(0.3125f, 1), {{0, 0, 0, 0, height}, {height, 0, 0, 0, 0}}};
    const double found = contact_of(falls, stands, {0, height});
    EXPECT_LE(found, height - 0.5) << height;
    EXPECT_NEAR(found, height - 0.5, 1e-5 + 1e-14 * height) << height;
  }
  // Beside a body of discs heights do not count.
  const MotionCase disc = disc_on(0.1875f, {{0, 0, 0, 0}});
  EXPECT_EQ(contact_of(disc, {sphere(0.3125f, 1), {{0, 0, 0, 0, 100}}}, {0, 1}), 0);
}

/// Discs of 3/16 m and 5/16 m that come together at 2 m a second from 10 m apart, and pass at a distance aside.
TEST(FirstContact, OfTwoDiscsIsThatOfTheFormula) {
  const MotionCase stands = disc_on(0.1875f, {{0, 0, 0, 1}});
  for (const double aside : {0.0, 0.3, 0.49, 0.499999}) {
    const MotionCase comes = disc_on(0.3125f, {{0, -10, aside, 0}, {10, 10, aside, 0}});
    const double expected = 5 - std::sqrt(0.25 - aside * aside) / 2;
    EXPECT_NEAR(contact_of(stands, comes, {0, 10}), expected, aside < 0.49 ? 2e-6 : 1e-3) << aside;
    EXPECT_LE(contact_of(stands, comes, {0, 10}), expected) << aside;
    EXPECT_EQ(contact_of(stands, comes, {0, 4}), never);
    EXPECT_EQ(contact_of(stands, comes, {5, 10}), 5);
    EXPECT_EQ(contact_of(stands, comes, {5.3, 10}), never);
  }
  EXPECT_EQ(contact_of(stands, disc_on(0.3125f, {{0, -10, 0.6, 0}, {10, 10, 0.6, 0}}), {0, 10}), never);
}

/// A disc 1 m away from the agent goes round as the agent turns by 20 rad in 10 s, and meets one that stands there.
TEST(FirstContact, FollowsWhatTurns) {
  const MotionCase turns{still_disc(0.0625f, 1, 0), {{0, 0, 0, 0}, {10, 0, 0, 20}}};
  for (const double angle : {0.5, 2.0, 6.0}) {
    const MotionCase stands = disc_on(0.0625f, {{0, std::cos(angle), std::sin(angle), 0}});
    const double expected = (angle - 2 * std::asin(0.0625)) / 2;
    for (const double tolerance : {0.1, 0.005, 1e-5}) {
      const double found = contact_of(turns, stands, {0, 10}, tolerance);
      EXPECT_LE(found, expected) << angle;
      EXPECT_GE(found, expected - tolerance / 1.9 - 1e-5) << angle;
    }
  }
}

/// A disc of one chunk is far away, that of the next stands where somebody else does.
TEST(FirstContact, SeesWhoIsThereWhereAChunkBegins) {
  AnimatedDiscs discs{{{{-1, 0}, 1, {{0, 5, 0.1f}, {0, 5, 0.1f}}}, {{0, 1}, 1, {{0, 0, 1}, {0, 0, 1}}}},
                      true};
  const MotionCase jumps{std::move(discs), {{0, 0, 0, 0}}, 7};
  const MotionCase stands = disc_on(0.1f, {{0, 0, 0, 0}});
  EXPECT_EQ(contact_of(jumps, stands, {7.5, 20}), 8);
  EXPECT_EQ(contact_of(jumps, stands, {7.5, 7.9}), never);
  EXPECT_EQ(contact_of(jumps, stands, {1.5, 20}), 2);  // the round before
}

/// Returns a clip whose disc goes 1 m along x at an even speed.
AnimatedDiscs disc_along_x(std::vector<double> times, bool loops) {
  AnimatedChunk chunk{std::move(times), 1, {}};
  const double begin = chunk.times.front(), seconds = chunk.times.back() - begin;
  for (const double time : chunk.times)
    chunk.keys.push_back({static_cast<float>(std::round((time - begin) / seconds * 8192) / 8192), 0, 0.25f});
  return {{chunk}, loops};
}

/// Two bodies stay within reach through many rounds, and touch when 0.7 of a later one have gone by.
TEST(FirstContact, KeepsTheTimeOfALoopThroughManyRounds) {
  for (const double length : {0.1, 0.3, 1.1}) {
    const double rounds = test::samples(300'000), after = rounds * length;
    const MotionCase plays{disc_along_x({0, length}, true), {{0, 0, 0, 0}}};
    const MotionCase comes =
        disc_on(0.25f, {{0, 1.2, 0.6, 0}, {after, 1.2, 0.6, 0}, {after + 0.1 * length, 1.2, 0, 0}});
    const double found = contact_of(plays, comes, {0, after + length}, 1e-6), expected = after + 0.7 * length;
    EXPECT_LE(found, expected) << length;
    EXPECT_GE(found, expected - 1e-5) << length;
  }
}

/// At the largest times too, where a double of a time is off by 1e-10 s: the shortest loops, and keys that are nearer to each other.
TEST(FirstContact, GoesOnThroughTheShortestTimes) {
  const MotionCase beside = disc_on(0.25f, {{0, 0.5, 0.75, 0}});
  for (const double begin : {-1e6, 0.1, 1e6}) {
    const MotionCase loops{disc_along_x({0, 0.001}, true), {{0, 0, 0, 0}}, begin};
    for (const double from : {-1e6, 1e5, 1e6 - 0.01})
      EXPECT_EQ(contact_of(loops, beside, {from, from + 0.01}), never);
  }
  for (const std::vector<double>& times : {std::vector<double>{0, 1e-12},
                                           {0, 1e-12, 1},
                                           {0, 1, 1 + 1e-12},
                                           {0, 1e-300},
                                           {0, 1e-12, 2e-12, 3e-12, 1}}) {
    const MotionCase once{disc_along_x(times, false), {{0, 0, 0, 0}}, 1e5};
    const MotionCase ahead = disc_on(0.25f, {{0, 1.25, 0, 0}});
    for (const double from : {1e5 - 1, 1e5, 1e5 + 1}) {
      const bool jumps = times.back() < 1;  // and may be anywhere, as far as rounding tells
      const double found = contact_of(once, ahead, {from, from + 2}),
                   expected = std::max(from, 1e5 + 0.75 * times.back());
      EXPECT_LE(found, expected);
      EXPECT_GE(found, jumps ? from : expected - 0.006);
      if (!jumps) {
        EXPECT_EQ(contact_of(once, beside, {from, from + 2}), never);
      }
    }
  }
}

/// What a jump of 100 m is off by, by rounding, does not count before and after it.
TEST(FirstContact, OfAJumpIsOnItsWay) {
  const MotionCase stands = disc_on(0.25f, {{0, 0, 0, 0}});
  for (const double seconds : {1e-3, 1e-6, 1e-9}) {
    const double back = 5 + seconds;
    const MotionCase leaves = disc_on(0.25f, {{0, 0.6, 0, 0}, {5, 0.6, 0, 0}, {back, 100, 0, 0}});
    EXPECT_EQ(contact_of(stands, leaves, {0, 10}), never) << seconds;
    const MotionCase comes = disc_on(0.25f, {{0, 99.6, 0, 0}, {5, 99.6, 0, 0}, {back, -0.4, 0, 0}});
    const double expected = 5 + (back - 5) * 0.991, found = contact_of(stands, comes, {0, 10}, 1e-6);
    EXPECT_LE(found, expected + 1e-15) << seconds;
    EXPECT_GE(found, expected - 1e-3 * seconds) << seconds;
    const MotionCase turns{test::still_disc(0.25f, 1, 0),
                           {{0, 0, 0, 2}, {5, 0, 0, 2}, {back, 0, 0, 2 + 20 * 3.14159265358979}}};
    const MotionCase beside = disc_on(0.25f, {{0, std::cos(2) * 1.6, std::sin(2) * 1.6, 0}});
    EXPECT_EQ(contact_of(turns, beside, {0, 10}), never) << seconds;
  }
}

/// Bodies that pass each other on ways of up to 2e9 m, at a distance aside that is just below that of a contact, or above.
TEST(FirstContact, IsFoundOnLongWays) {
  Random random(3104);
  const MotionCase stands = disc_on(0.25f, {{0, 0, 0, 0}});
  for (std::uint32_t i = 0; i < test::samples(400); ++i) {
    const double half = std::exp(random.uniform(0, 20.7)), angle = random.uniform(-4, 4), c = std::cos(angle),
                 s = std::sin(angle), aside = i % 2 == 0 ? 0.4999 : 0.52;
    const auto key = [&](double time, double along) {
      return PathKey{time, along * c - aside * s, along * s + aside * c, 0};
    };
    const double found = contact_of(stands, disc_on(0.25f, {key(0, -half), key(2, half)}), {0, 2});
    EXPECT_EQ(found < never, i % 2 == 0) << half;
    EXPECT_LE(std::min(found, 1.0), 1) << half;
  }
}

TEST(FirstContact, TellsTheSameToAnyThreadsSplitOrderAndLaterEnd) {
  Random random(3102);
  std::vector<MotionCase> cases;
  for (int i = 0; i < 40; ++i) cases.push_back(test::random_motion(random));
  std::vector<Motion> motions;
  for (const MotionCase& each : cases) motions.push_back(each.motion());
  std::vector<Pair> pairs, exchanged;
  for (std::uint32_t i = 0; i < test::samples(600); ++i) {
    pairs.push_back({random.below(40), random.below(40)});
    exchanged.push_back({pairs.back().second, pairs.back().first});
  }
  const auto times_of = [&](std::span<const Pair> asked, double to, unsigned threads) {
    std::vector<double> times(asked.size());
    test::on_threads(threads, [&] { first_contact(motions, asked, {-2, to}, times); });
    return times;
  };
  const std::vector<double> times = times_of(pairs, 3, 1);
  EXPECT_EQ(times_of(pairs, 3, 8), times);
  EXPECT_EQ(times_of(exchanged, 3, 8), times);
  const std::vector<double> later = times_of(pairs, 30, 8), sooner = times_of(pairs, 0, 8);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (times[i] < never) {
      EXPECT_EQ(later[i], times[i]);
    }
    EXPECT_EQ(sooner[i], times[i] <= 0 ? times[i] : never);
    EXPECT_EQ(times_of(std::span(pairs).subspan(i, 1), 3, 1)[0], times[i]);
  }
  const std::span<const Motion> others = std::span(motions).subspan(1);
  double first = never;
  for (std::uint32_t i = 1; i < 40; ++i) {
    double time = 0;
    first_contact(motions, std::vector<Pair>{{0, i}}, {-2, 3}, {&time, 1});
    first = std::min(first, time);
  }
  EXPECT_EQ(free_until(motions[0], others, {-2, 3}), first);
  EXPECT_EQ(free_until(motions[0], {}, {-2, 3}), never);
}

TEST(FirstContact, IsThatOfTheOriginFarFromIt) {
  Random random(3103);
  for (std::uint32_t i = 0; i < test::samples(100); ++i) {
    MotionCase a = test::random_motion(random), b = test::random_motion(random);
    const double here = contact_of(a, b, {-2, 3});
    for (MotionCase* const each : {&a, &b})
      for (PathKey& key : each->path) key.x += 1e8, key.y -= 1e8;
    const double there = contact_of(a, b, {-2, 3});
    if (here == never || there == never) continue;  // a pass by the tolerance is one here and none there
    // Just behind, too: a chunk may begin there.
    EXPECT_LT(std::min(test::gap_at(a, b, there), test::gap_at(a, b, there + 1e-8)), 0.0051);
  }
}

TEST(FirstContact, RefusesWhatIsNoMotion) {
  const MotionCase good = disc_on(0.1f, {{0, 0, 0, 0}, {1, 1, 0, 0}});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> times(1);
  const auto said_of = [&](const Motion& motion, TimeInterval interval = {0, 1}, double tolerance = 0.005) {
    const std::vector<Motion> motions = {good.motion(), motion};
    return test::complaint([&] {
      first_contact(motions, std::vector<Pair>{{0, 1}}, interval, times, tolerance);
    });
  };
  const auto with_path = [&](std::vector<PathKey> path) { return said_of({&good.shape, path, 0}); };
  EXPECT_EQ(said_of(good.motion()), "accepted");
  EXPECT_EQ(said_of({nullptr, good.path, 0}), "first_contact: motion 1: expected a shape, found none");
  EXPECT_EQ(said_of({&good.shape, good.path, nan}),
            "first_contact: motion 1: expected a clip that begins within +-1e6 s, found nan");
  EXPECT_EQ(with_path({}), "first_contact: motion 1: expected a path of keys, found none");
  EXPECT_EQ(with_path({{0, 0, 0, 0}, {0, 0, 0, 0}}),
            "first_contact: motion 1: key 1 of its path: expected a time after 0 s, found 0");
  EXPECT_EQ(with_path({{nan, 0, 0, 0}}),
            "first_contact: motion 1: key 0 of its path: expected a time within +-1e6 s, found nan");
  EXPECT_EQ(
      with_path({{0, 2e9, 0, 0}}),
      "first_contact: motion 1: key 0 of its path: expected a position within +-1e9 m, found (2e+09, 0)");
  EXPECT_EQ(with_path({{0, 0, 0, 0, 2e9}}),
            "first_contact: motion 1: key 0 of its path: expected a z within +-1e9 m, found 2e+09");
  EXPECT_EQ(with_path({{0, 0, 0, nan}}),
            "first_contact: motion 1: key 0 of its path: expected a heading within +-1e9 rad, found nan");
  EXPECT_EQ(
      with_path({{0, 0, 0, 0}, {1, 0, 0, 1001}}),
      "first_contact: motion 1: key 1 of its path: expected a turn of at most 1000 rad, found one to 1001");
  EXPECT_EQ(said_of(good.motion(), {1, 0}),
            "first_contact: expected an interval within +-1e6 s, found 1 to 0");
  EXPECT_EQ(said_of(good.motion(), {nan, 0}),
            "first_contact: expected an interval within +-1e6 s, found nan to 0");
  EXPECT_EQ(said_of(good.motion(), {0, 1}, 0),
            "first_contact: expected a tolerance of at least 1e-6 m, found 0");
  EXPECT_EQ(said_of(good.motion(), {0, 1}, nan),
            "first_contact: expected a tolerance of at least 1e-6 m, found nan");
  EXPECT_EQ(test::complaint([&] {
              first_contact(std::vector<Motion>{good.motion()}, std::vector<Pair>{{0, 1}}, {0, 1}, times);
            }),
            "first_contact: pair 0: expected one of 1 motions, found 1");
  EXPECT_NE(test::complaint([&] { first_contact({}, {}, {0, 1}, times); }), "accepted");
  EXPECT_EQ(test::complaint([&] {
              free_until(Motion{nullptr, good.path, 0}, std::vector<Motion>{good.motion()}, {0, 1});
            }),
            "free_until: motion 1: expected a shape, found none");
}

}  // namespace
}  // namespace bch
