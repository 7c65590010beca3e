// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <bch/collide.hpp>
#include <bch/time_of_impact.hpp>

#include "tests/support/complaint.hpp"
#include "tests/support/moving_bodies.hpp"
#include "tests/support/scenes.hpp"

// Bodies in slabs that move: their first contacts, their shapes at every time, and what is refused.

namespace bch {
namespace {

using test::MotionCase;
using test::Random;

constexpr double never = std::numeric_limits<double>::infinity();
const std::vector<float> planes = {0.4f, 1.1f};

double contact_of(const MotionCase& a, const MotionCase& b, double tolerance) {
  std::vector<double> times(2);
  first_contact(std::vector<Motion>{a.motion(), b.motion()}, std::vector<Pair>{{0, 1}, {1, 0}}, {-2, 3},
                times, tolerance);
  EXPECT_EQ(times[0], times[1]);
  return times[0];
}

TEST(MotionSlabs, TouchFirstWhereTheFirstSlabDoes) {
  Random random(3161);
  int contacts = 0, later = 0;
  for (std::uint32_t i = 0; i < test::samples(600); ++i) {
    const MotionCase a = test::random_motion(random, test::sliced_body(random, planes)),
                     b = i % 4 == 0 ? test::random_motion(random)
                                    : test::random_motion(random, test::sliced_body(random, planes));
    const double tolerance = std::exp(random.uniform(-9, -3)), found = contact_of(a, b, tolerance);
    for (double time = -2; time < std::min(found, 3.0); time += 0.002)
      ASSERT_FALSE(test::meeting_at(a, b, time).overlap()) << i << ": at " << time << ", found " << found;
    if (found == never) continue;
    const test::Meeting meeting = test::meeting_at(a, b, found),
                        behind = test::meeting_at(a, b, found + 1e-9);
    EXPECT_TRUE(meeting.nested || behind.nested || std::min(meeting.gap, behind.gap) <= tolerance + 2e-5)
        << i << ": gaps of " << meeting.gap << " and " << behind.gap << " at " << found;
    ++contacts;
    if (b.discs.slabs.empty()) continue;
    // The lowest slabs alone may touch later than all.
    const AnimatedDiscs low_a{a.discs.slabs[0].chunks, a.discs.loops},
        low_b{b.discs.slabs[0].chunks, b.discs.loops};
    later += contact_of({low_a, a.path, a.clip_begin}, {low_b, b.path, b.clip_begin}, tolerance) > found;
  }
  EXPECT_GT(contacts, static_cast<int>(test::samples(200)));
  EXPECT_GT(later, static_cast<int>(test::samples(40)));
}

TEST(MotionSlabs, AreShapesOfSlabsAtEveryTime) {
  Random random(3162);
  int hits = 0, misses = 0;
  for (std::uint32_t i = 0; i < test::samples(800); ++i) {
    const auto motion = [&](bool whole) {
      const PathKey key = {0, random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(-4, 4)};
      return MotionCase{whole ? test::ringed_body(random) : test::sliced_body(random, planes), {key}};
    };
    const MotionCase a = motion(false), b = motion(i % 4 == 0);
    const double time = random.uniform(-1, 2);
    const auto shape_of = [&](const MotionCase& of) { return of.shape.shape(time + of.shape.begin()); };
    const ShapeSet set({{shape_of(a), shape_of(b)}}, {.slices = planes});
    const std::vector<std::uint32_t> shape = {0, 1};
    const std::vector<double> x = {a.path[0].x, b.path[0].x}, y = {a.path[0].y, b.path[0].y},
                              heading = {a.path[0].heading, b.path[0].heading};
    std::vector<std::uint8_t> hit(1);
    collide(set, {shape, x, y, heading}, std::vector<Pair>{{0, 1}}, hit, {.semantics = Semantics::solid});
    const test::Meeting meeting = test::meeting_at(a, b, time);
    if (meeting.overlap()) {
      EXPECT_EQ(hit[0], 1) << i;
    }
    if (hit[0] == 1) {
      EXPECT_TRUE(meeting.nested || meeting.gap <= 1e-5) << i << ": " << meeting.gap;
    }
    ++(hit[0] == 1 ? hits : misses);
  }
  EXPECT_GT(hits, static_cast<int>(test::samples(200)));
  EXPECT_GT(misses, static_cast<int>(test::samples(100)));
}

/// A disc in each of some slabs of three, for a second.
AnimatedDiscs discs_in(const std::vector<bool>& slabs) {
  AnimatedDiscs body;
  body.slices = planes;
  for (const bool is_there : slabs) {
    AnimatedChunk chunk{{0, 1}, 0, {}, {}};
    if (is_there) chunk = test::still_disc(0.125f).chunks[0];
    body.slabs.emplace_back().chunks = {chunk};
  }
  return body;
}

TEST(MotionSlabs, PassOverEachOtherAndWholeBodiesTakePartWhereTheyReach) {
  const std::vector<PathKey> path = {{0, 0, 0, 0}};
  const MotionCase low{discs_in({true, false, false}), path}, high{discs_in({false, false, true}), path},
      both{discs_in({true, false, true}), path}, whole{test::still_disc(0.125f), path};
  EXPECT_EQ(contact_of(low, high, 0.001), never);
  EXPECT_EQ(contact_of(low, both, 0.001), -2);
  EXPECT_EQ(contact_of(high, both, 0.001), -2);
  EXPECT_EQ(contact_of(high, whole, 0.001), -2);
  AnimatedDiscs dog = test::still_disc(0.125f);
  dog.heights = {0, 0.5f};
  const MotionCase below{std::move(dog), path};
  EXPECT_EQ(contact_of(below, high, 0.001), never);
  EXPECT_EQ(contact_of(below, low, 0.001), -2);
  EXPECT_EQ(contact_of(below, whole, 0.001), -2);
  EXPECT_EQ(free_until(high.motion(), std::vector<Motion>{low.motion(), below.motion()}, {0, 1}), never);
  EXPECT_EQ(free_until(high.motion(), std::vector<Motion>{low.motion(), both.motion()}, {0, 1}), 0);
  EXPECT_EQ(high.shape.discs(0.5), std::vector<Disc>({{0, 0, 0.125f}}));
  EXPECT_EQ(both.shape.discs(0.5).size(), 2u);
}

TEST(MotionSlabs, AreRefusedWhereTheirPlanesDiffer) {
  const std::vector<PathKey> path = {{0, 0, 0, 0}};
  AnimatedDiscs cut_elsewhere = discs_in({true, true, true});
  cut_elsewhere.slices = {0.4f, 1.2f};
  const MotionCase a{discs_in({true, true, true}), path}, b{std::move(cut_elsewhere), path};
  EXPECT_EQ(test::complaint([&] { contact_of(a, b, 0.001); }),
            "first_contact: pair 0: motions 0 and 1 have bodies that are cut at different planes");
  EXPECT_EQ(test::complaint([&] {
              free_until(a.motion(), std::vector<Motion>{a.motion(), b.motion()}, {0, 1});
            }),
            "free_until: motion 1 has a body that is cut at other planes");
}

TEST(MotionSlabs, AreRefusedWhereTheyAreNoBody) {
  const AnimatedDiscs good = discs_in({true, false, true});
  const auto said_of = [](const AnimatedDiscs& body) {
    return test::complaint([&] { AnimatedShape{body}; });
  };
  EXPECT_EQ(said_of(good), "accepted");
  EXPECT_EQ(said_of(discs_in({false, false, false})), "animated shape: all slabs are empty");
  AnimatedDiscs bad = good;
  bad.heights = {0, 1.05f};
  EXPECT_EQ(
      said_of(bad),
      "animated shape: slab 2: it has discs, and the body's heights, from 0 to 1.05 m, do not reach it");
  bad = good;
  bad.slabs.pop_back();
  EXPECT_EQ(said_of(bad), "animated shape: 2 slabs for 2 planes");
  bad = good;
  bad.slices = {1, 1};
  EXPECT_EQ(said_of(bad), "slices: plane 1 at 1 m does not ascend");
  bad = good;
  bad.chunks = good.slabs[0].chunks;
  EXPECT_EQ(said_of(bad), "animated shape: chunks beside slabs");
  bad = good;
  bad.slabs[1].slabs.resize(1);
  EXPECT_EQ(said_of(bad), "animated shape: slab 1: slabs of a slab");
  bad = good;
  bad.slabs[1].chunks[0].times = {0, 2};
  EXPECT_EQ(said_of(bad), "animated shape: slab 1: it begins or ends at another time than slab 0");
  bad = good;
  bad.slabs[2].chunks.clear();
  EXPECT_EQ(said_of(bad), "animated shape: slab 2: no chunks");
  bad = good;
  bad.slabs[0].chunks[0].keys[0].radius = -1;
  EXPECT_EQ(said_of(bad), "animated shape: slab 0: chunk 0: disc 0 at key 0, of -1 m at (0, 0) m");
  bad = good;
  bad.slabs[1].chunks[0].keys.resize(1);
  EXPECT_EQ(said_of(bad), "animated shape: slab 1: chunk 0: 1 discs at 2 keys, not 0 at each");
  bad = good;
  bad.heights = {1, 0};
  EXPECT_EQ(said_of(bad), "animated shape: heights from 1 to 0 m");
}

}  // namespace
}  // namespace bch
