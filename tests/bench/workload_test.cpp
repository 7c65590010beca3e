// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/workload/workload.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "bench/workload/outline_contacts.hpp"

namespace bch::bench {
namespace {

/// Where all of a shape is its root disc, no pair's root discs overlap while its hierarchies do not.
TEST(RandomPairs, GivesUpWhereNoneIsWanted) {
  const std::vector<Shape> shapes = {{{}, fixed_cylinder(0.25f)}};
  std::uint32_t asked = 0;
  try {
    random_pairs("no_hit", 1, shapes, 10, [&](const Agents&, Pair) { return ++asked <= 3; });
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()),
              "workload no_hit: of 1000000 pairs at random after the first 3 none is wanted");
  }
}

TEST(RandomPairs, HasAsManyAsAreWanted) {
  const std::vector<Shape> shapes = {{{}, fixed_cylinder(0.25f)}};
  std::uint32_t asked = 0;
  const Workload workload =
      random_pairs("every third", 1, shapes, 10, [&](const Agents&, Pair) { return ++asked % 3 == 0; });
  EXPECT_EQ(workload.pairs.size(), 10u);
  EXPECT_EQ(workload.crowd.size(), 20u);
  EXPECT_EQ(asked, 30u);
}

/// Outlines lie within moving discs, so that they meet no sooner, and mostly soon after.
TEST(OutlineContacts, AreBehindFirstContacts) {
  const std::vector<cli::LoadedCharacter> people = {cli::load_character("default:male", {})};
  const std::vector<AnimatedClip> clips = animated_clips(people, "walk", 0.6);
  ASSERT_EQ(clips.size(), 1u);
  EXPECT_EQ(clips[0].seconds, 0.5);
  const MotionScene scene(clips, 60, 1);
  const OutlineContacts outlines = outline_contacts(scene);
  const std::size_t contacts = scene.pairs(true).size();
  EXPECT_GT(contacts, 20u);
  EXPECT_LE(outlines.meeting, contacts);
  EXPECT_GT(outlines.meeting, contacts * 3 / 4);
  EXPECT_EQ(outlines.late, 0u);
  EXPECT_GT(outlines.ahead, 0);
  EXPECT_LT(outlines.ahead, 0.1);
}

/// The discs of these bodies are much smaller than their outlines.
TEST(OutlineContacts, FindsWhatIsLate) {
  const std::vector<cli::LoadedCharacter> people = {cli::load_character("default:male", {})};
  std::vector<AnimatedClip> clips = animated_clips(people, "walk", 0.6);
  const AnimatedDiscs small{{{{0, 0.5}, 1, {{0, 0, 0.1f}, {0, 0, 0.1f}}, {}}}, true};
  clips[0].shape = AnimatedShape(small);
  const OutlineContacts outlines = outline_contacts(MotionScene(clips, 60, 1));
  EXPECT_GT(outlines.late, 20u);
  EXPECT_EQ(outlines.late, outlines.meeting);
}

}  // namespace
}  // namespace bch::bench
