// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/walkers.hpp"

#include <malloc.h>

#include <cstdio>

#include "kernel/recordings/walker_shapes.hpp"
#include "layout/default_character/pedestrian_speeds.hpp"
#include "tests/support/made_up_recording.hpp"
#include "tests/support/outline_checks.hpp"
#include "tests/support/test.hpp"

// What is told of somebody who is tracked: speed, heading, stature, and the pose that stands for them.

namespace bch::detail {
namespace {

using test::MadeUp;
using test::unknown;

std::vector<WalkerFrame> walkers_of(MadeUp& recording) {
  recording.rewind();
  WalkerReader reader(recording);
  std::vector<WalkerFrame> all;
  for (WalkerFrame frame; reader.next(frame);) all.push_back(frame);
  return all;
}

TEST(Walkers, HaveTheirSpeedAndDirection) {
  MadeUp recording(25);
  recording.walk(3, 0, 0, 0.6, 0.8, 100);
  const auto frames = walkers_of(recording);
  ASSERT_EQ(frames.size(), 100u);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const Walker& walker = frames[k].people.at(0);
    EXPECT_EQ(frames[k].frame, static_cast<std::int64_t>(k));
    EXPECT_NEAR(walker.speed, 1, 1e-9);
    EXPECT_NEAR(walker.heading, std::atan2(0.8, 0.6), 1e-9);
    EXPECT_FALSE(walker.is_guessed);
    EXPECT_FLOAT_EQ(static_cast<float>(walker.stature), 1.75f);
    if (k == 0) continue;
    const double step = walker.phase - frames[k - 1].people[0].phase;
    EXPECT_NEAR(step - std::floor(step), pedestrian_strides_per_second(1) / 25, 1e-9);
  }
}

TEST(Walkers, KeepTheirHeadingWhileTheyStand) {
  MadeUp recording(25);
  recording.walk(1, 0, 0, 0, 1, 50);
  for (int k = 50; k < 100; ++k) recording.add(k, {1, 0, 1.96, unknown, unknown});
  recording.walk(2, 5, 5, 0, 0, 100);  // never moves
  std::size_t guessed = 0;
  for (const WalkerFrame& frame : walkers_of(recording)) {
    EXPECT_NEAR(frame.people[0].heading, std::numbers::pi / 2, 1e-9) << frame.frame;
    EXPECT_NEAR(frame.people[1].heading, frame.frame < 50 ? std::numbers::pi / 2 : frame.people[1].heading,
                1e-9);
    EXPECT_TRUE(frame.people[1].is_guessed);
    guessed += frame.people[0].is_guessed;
  }
  EXPECT_NEAR(static_cast<double>(guessed), 42, 3);  // from when half of the smoothing says that he stands
}

/// As recordings of simulators are that write a frame a second.
TEST(Walkers, FaceTheWayOfTheirFirstStepBefore) {
  MadeUp recording(10);
  recording.walk(1, 5, 5, 1, 0, 60);  // where a crowd goes
  for (int k = 0; k < 60; ++k) {      // two who go elsewhere after 3 s, of whom one is there later
    const double y = std::max(0, k - 30) * 0.12;
    recording.add(k, {2, 0, -y, unknown, unknown});
    if (k >= 8) recording.add(k, {3, 9, y, unknown, unknown});
    if (k >= 50) recording.add(k, {4, 2, 2, unknown, unknown});  // who does not move
  }
  recording.rewind();
  WalkerReader reader(recording);
  for (WalkerFrame frame; reader.next(frame);)
    for (const Walker& walker : frame.people) {
      const double expected[] = {0, -std::numbers::pi / 2, std::numbers::pi / 2, 0};
      if (walker.id != 4) {
        EXPECT_NEAR(walker.heading, expected[walker.id - 1], 1e-9) << frame.frame;
      }
      if (frame.frame >= 26 && frame.frame <= 29) continue;  // about where his speed is that of who stands
      EXPECT_EQ(walker.is_guessed, walker.id == 4 || (walker.id != 1 && frame.frame < 28)) << frame.frame;
    }
}

TEST(Walkers, ComeAndGo) {
  MadeUp recording(10);
  recording.walk(1, 0, 0, 1, 0, 40);
  for (int k = 10; k < 30; ++k) recording.add(k, {2, 0, 5, unknown, unknown});
  recording.rewind();
  WalkerReader reader(recording);
  std::string text;
  for (WalkerFrame frame; reader.next(frame);)
    for (const Walker& walker : frame.people)
      if (walker.comes_or_goes) text += std::to_string(walker.id) + ":" + std::to_string(frame.frame) + " ";
  EXPECT_EQ(text, "2:10 2:11 2:12 2:13 2:26 2:27 2:28 2:29 ");  // 0.4 s of either end
}

TEST(Walkers, OfFewFramesHaveASpeedToo) {
  MadeUp recording(40);
  for (int k = 0; k < 10; ++k) recording.add(40 * k, {1, 1.2 * k, 0, unknown, unknown});
  for (const WalkerFrame& frame : walkers_of(recording)) {
    EXPECT_NEAR(frame.people[0].speed, 1.2, 1e-9) << frame.frame;
    EXPECT_FALSE(frame.people[0].is_guessed);
  }
}

TEST(Walkers, DoNotJumpAHundredMetres) {
  MadeUp recording(10);
  recording.add(0, {4, 0, 0, unknown, unknown});
  recording.add(100, {4, 99, 0, unknown, unknown});
  EXPECT_EQ(walkers_of(recording).size(), 2u);
  recording.add(110, {4, 300, 0, unknown, unknown, TrackedPerson::no_motion, unknown, 7});
  EXPECT_EQ(test::complaint<TrajectoryError>([&] { walkers_of(recording); }),
            "made up: row 7: person 4 jumps by 201 m, from (99, 0) in frame 100 to (300, 0) in frame 110");
}

TEST(Walkers, TakeHeadingsOfTheFile) {
  MadeUp recording(10);
  for (int k = 0; k < 20; ++k) recording.add(k, {1, 0.1 * k, 0, 1.5f, 1.6f});
  for (const WalkerFrame& frame : walkers_of(recording)) {
    EXPECT_FLOAT_EQ(static_cast<float>(frame.people[0].heading), 1.5f);
    EXPECT_FALSE(frame.people[0].is_guessed);
  }
}

/// So many people that those who left are forgotten, in place of being held.
void add_many_others(MadeUp& recording, std::int64_t people, std::int64_t frames) {
  for (std::int64_t k = 0; k < people; ++k)
    recording.add(k % frames, {1000 + k, 500 + 3.0 * static_cast<double>(k / frames), 0, 0, unknown});
}

TEST(Walkers, GoOnWhenTheyComeBack) {
  std::vector<std::vector<Walker>> told;
  for (const std::int64_t others : {800, 20'000}) {  // in all frames, because these are read ahead
    MadeUp recording(25);
    for (const std::int64_t frame : {0, 300, 325, 357, 700})  // away for a while, a short one and a long one
      for (int k = 0; k < 20; ++k)
        recording.add(frame + k,
                      {7, 0.001 * static_cast<double>(frame) + 0.04 * k, 0.02 * k, unknown, unknown});
    for (const std::int64_t frame : {0, 600})  // stands, and walks when he is back
      for (int k = 0; k < 20; ++k)
        recording.add(frame + k, {8, 9, frame > 0 ? 0.05 * k : 0, unknown, unknown});
    add_many_others(recording, others, 800);
    recording.rewind();
    WalkerReader reader(recording);
    std::vector<Walker>& all = told.emplace_back();
    for (WalkerFrame frame; reader.next(frame);)
      for (const Walker& walker : frame.people)
        if (walker.id < 1000 && !(walker.id == 8 && walker.is_guessed)) all.push_back(walker);
    EXPECT_EQ(reader.people(), 2u + static_cast<std::size_t>(others));
  }
  ASSERT_EQ(told[0].size(), told[1].size());
  for (std::size_t i = 0; i < told[0].size(); ++i) {
    const Walker &one = told[0][i], &other = told[1][i];
    const auto all_of = [](const Walker& w) {
      return std::tie(w.id, w.x, w.heading, w.speed, w.phase, w.stature, w.is_female, w.is_guessed, w.way,
                      w.seconds);
    };
    EXPECT_EQ(all_of(one), all_of(other)) << i;
  }
}

TEST(Walkers, WhoHaveLeftTakeLittleMemory) {
  constexpr std::int64_t people = 200'000;
  MadeUp recording(25);
  add_many_others(recording, people, 4000);
  recording.rewind();
  WalkerReader reader(recording);
  const auto used = [] { return mallinfo2().uordblks + mallinfo2().hblkhd; };  // 0 under a sanitizer
  const std::size_t before = used();
  for (WalkerFrame frame; reader.next(frame);) {
  }
  EXPECT_LT(static_cast<double>(used() - before), 150.0 * people);
  EXPECT_EQ(reader.people(), static_cast<std::size_t>(people));
}

TEST(Walkers, WithoutAStatureHaveOneByTheirIds) {
  double women = 0, men = 0;
  std::size_t count = 0;
  for (std::int64_t id = 0; id < 4'000; ++id) {
    const double stature = stature_by_id(id, is_female_by_id(id));
    EXPECT_GT(stature, 1.3);
    EXPECT_LT(stature, 2.2);
    (is_female_by_id(id) ? women : men) += stature;
    count += is_female_by_id(id);
  }
  EXPECT_NEAR(static_cast<double>(count), 2'000, 150);
  EXPECT_NEAR(women / static_cast<double>(count), 1.66, 0.01);
  EXPECT_NEAR(men / (4'000 - static_cast<double>(count)), 1.79, 0.01);
}

/// Returns how far what one outline encloses sticks out of the other, metres. (Where an arm meets the body, what it goes round is suddenly inside:
/// that is no movement.)
double farthest(const Outline& a, const Outline& b) {
  double most = 0;
  for (const Vec2& p : a.points) {
    const double x = p.x, y = p.y;
    if (!test::inside(b, x, y)) most = std::max(most, test::distance_to(b, x, y));
  }
  return most;
}

struct Farthest {
  double by_phase = 0, by_speed = 0;
};

/// Of the pose that is built and that of a walker's own phase and speed, to either of which half a step is missing.
Farthest farthest_poses(std::uint32_t coarse) {
  Farthest all;
  for (const bool is_female : {false, true}) {
    const Character person = default_pedestrian(is_female ? Sex::female : Sex::male, 1.7);
    ShapeBuilder shape_builder(person), other(person);
    for (std::uint32_t clip = 0; clip + coarse < pedestrian_speeds; clip += 4 * coarse) {
      Walker walker{1, 0, 0, 0, pedestrian_speed_step * clip, 0, 1.7, is_female, false};
      const auto at = [&](std::uint32_t k) {
        return PoseTime{
            k, static_cast<float>(walker.phase / pedestrian_strides_per_second(pedestrian_speed_step * k))};
      };
      for (walker.phase = 0.003; walker.phase < 1; walker.phase += 0.09) {
        const Outline own = shape_builder.shape(at(clip)).outline;
        const Outline built = other.shape(WalkerPose(walker, Shoulders::straight, coarse).at()).outline;
        all.by_phase = std::max({all.by_phase, farthest(built, own), farthest(own, built)});
        const Outline faster = other.shape(at(clip + coarse)).outline;
        all.by_speed = std::max({all.by_speed, farthest(own, faster) / 2, farthest(faster, own) / 2});
      }
    }
  }
  return all;
}

TEST(WalkerPoses, ChangeOutlinesByNoMoreThanACentimetre) {
  for (const std::uint32_t coarse : {1u, 3u}) {
    const auto [by_phase, by_speed] = farthest_poses(coarse);
    EXPECT_LT(std::max(by_phase, by_speed), 0.01 * coarse);
    EXPECT_GT(std::min(by_phase, by_speed), 0.001);
    std::printf("phases change outlines by %.1f mm at most, speeds by %.1f mm\n", 1000 * by_phase,
                1000 * by_speed);
  }
}

}  // namespace
}  // namespace bch::detail
