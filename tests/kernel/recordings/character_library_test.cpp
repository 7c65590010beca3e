// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/character_library.hpp"

#include "kernel/recordings/baked_library.hpp"
#include "layout/default_character/pedestrian_speeds.hpp"
#include "tests/support/made_up_recording.hpp"
#include "tests/support/test.hpp"

// Characters and baked shapes that stand for the people of a recording.

namespace bch::detail {
namespace {

using test::add_crowd;
using test::check_of;
using test::MadeUp;
using test::unknown;

/// Clips of characters walk at the speed and in the direction of their feet, and the distance drives them.
TEST(CharacterLibrary, WalksAsItsClipsSay) {
  constexpr double speed = 1.2;
  Character person = default_pedestrian(Sex::male, 1.8);
  const auto clip = static_cast<std::uint32_t>(std::lround(speed / pedestrian_speed_step));
  person.clips = {person.clips[0], person.clips[clip / 2], person.clips[clip]};
  // Facing -y, as most files do.
  for (std::size_t k = 0; k < 4; ++k) {
    std::swap(person.to_ground.rows[0][k], person.to_ground.rows[1][k]);
    person.to_ground.rows[1][k] *= -1;
  }
  const CharacterEntry member = character_entry(person, "somebody");
  EXPECT_NEAR(member.height, 1.8, 0.05);
  ASSERT_EQ(member.walks.size(), 2u);
  EXPECT_NEAR(member.clips[member.walks[0]].speed, speed / 2, 0.1);
  EXPECT_NEAR(member.clips[member.walks[1]].speed, speed, 0.1);
  ASSERT_EQ(member.idles.size(), 1u);
  Walker walker{1, 0, 0, 0, speed, 0, member.height, false, false};
  EXPECT_EQ(library_pose({&member, 1}, {}, walker, 1).clip, 2u);
  const double seconds = static_cast<double>(person.clips[2].seconds);
  walker.way = 100.5 * seconds * member.clips[member.walks[1]].speed;
  EXPECT_NEAR(static_cast<double>(library_pose({&member, 1}, {}, walker, 1).seconds), seconds / 2, 0.03);
  walker.speed = 0.4;
  EXPECT_EQ(library_pose({&member, 1}, {}, walker, 1).clip, 1u);
  walker.speed = 0.1;
  EXPECT_EQ(library_pose({&member, 1}, {}, walker, 1).clip, 0u);
  const CharacterEntry half = character_entry(scaled(member, member.height / 2), "half of him");
  EXPECT_NEAR(half.height, member.height / 2, 1e-3);
  EXPECT_NEAR(half.clips[half.walks[1]].speed, member.clips[member.walks[1]].speed / 2, 1e-3);
  // It walks along +x, as those people do that need no turn.
  const CharacterEntry straight = character_entry(default_pedestrian(Sex::male, 1.8), "him");
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(member.character.to_ground.rows[row][k], straight.character.to_ground.rows[row][k], 0.02);
  person.clips = {};
  EXPECT_THROW(character_entry(person, "nobody"), std::invalid_argument);
}

std::string complaint(const NamedMotion& named, const CharacterLibrary& library) {
  return test::complaint<TrajectoryError>([&] { library_motions({&named, 1}, library); });
}

/// Rows choose the body, the clip and the time in it; what they leave open is chosen as without them.
TEST(CharacterLibrary, PlaysWhatRowsName) {
  CharacterLibrary library;
  for (const char* const name : {"a.glb", "b.glb"}) library.push_back(character_entry(default_male(), name));
  const auto seconds = [&](std::uint32_t clip) { return library[0].clips[clip].seconds; };
  const std::vector<NamedMotion> named{{"b", library[0].clips[1].name, "f:1"}, {"a.glb", "", "f:2"}};
  const auto motions = library_motions(named, library);
  Walker walker{1, 0, 0, 0, 1.2, 0, 1.75, false, false};
  walker.motion = 0, walker.clip_seconds = static_cast<float>(3.25 * seconds(1));
  LibraryPose pose = library_pose(library, motions, walker, 1);
  EXPECT_EQ(pose.member, 1u);
  EXPECT_EQ(pose.clip, 1u);
  EXPECT_NEAR(static_cast<double>(pose.seconds), seconds(1) / 4, seconds(1) / library[0].clips[1].phases);
  walker.motion = 1, walker.clip_seconds = unknown;
  pose = library_pose(library, motions, walker, 1);
  EXPECT_EQ(pose.member, 0u);
  EXPECT_TRUE(std::ranges::count(library[0].walks, pose.clip));
  EXPECT_EQ(complaint({"c.glb", "", "f:7"}, library), "f:7: character 'c.glb' is none of 'a.glb', 'b.glb'");
  EXPECT_TRUE(
      complaint({"", "fly", "f:8"}, library).starts_with("f:8: clip 'fly' is not in 'a.glb', which has "));
  EXPECT_EQ(complaint({"", "fly", "f:8"}, {}),
            "f:8: clip 'fly' needs a file that has it: --character has to name it");
  library[1].name = "a.fbx";
  EXPECT_EQ(complaint({"a", "", "f:9"}, library), "f:9: character 'a' may be several of 'a.glb', 'a.fbx'");
}

/// Shapes of a clip of the built-in man, and of another, turned by an angle, at 20 a second.
BakedShapes baked_man(double turn) {
  Character man = default_male();
  for (std::size_t k = 0; k < 4; ++k) {
    const float x = man.to_ground.rows[0][k], y = man.to_ground.rows[1][k];
    const auto c = static_cast<float>(std::cos(turn)), s = static_cast<float>(std::sin(turn));
    man.to_ground.rows[0][k] = c * x - s * y, man.to_ground.rows[1][k] = s * x + c * y;
  }
  const auto clip_of = [&](const char* name) {
    return static_cast<std::uint32_t>(std::ranges::find(man.clips, name, &Clip::name) - man.clips.begin());
  };
  ShapeOrigins origins{0.02, {"man.glb", "walk", "idle phone"}, {}};
  ShapeBuilder shape_builder(man);
  std::vector<Shape> shapes;
  for (const std::uint32_t name : {1u, 2u})
    for (int k = 0; k < 20; ++k) {  // steps of a second; a clip that stands is cut short
      const float seconds = static_cast<float>(k) / 20;
      shapes.push_back(shape_builder.shape({clip_of(origins.names[name].c_str()), seconds}));
      origins.origins.push_back({0, name, seconds});
    }
  return {ShapeSet(shapes), origins};
}

TEST(BakedCast, MovesAsItsShapesAndSpeedsSay) {
  const BakedShapes baked = baked_man(0);
  const std::vector<ClipSpeed> speeds{{"walk", 1.3}, {"idle phone", 0}};
  const CharacterLibrary library = baked_library(baked, "people.bch", speeds);
  ASSERT_EQ(library.size(), 1u);
  Walker walker{1, 0, 0, 0, 1.2, 0, 1.75, false, false};
  const auto shape_at = [&](double way) {
    walker.way = way;
    const LibraryPose pose = library_pose(library, {}, walker, 1);
    return library[0].clips[pose.clip].baked[pose.phase].shape;
  };
  EXPECT_EQ(shape_at(0), 0u);
  EXPECT_EQ(shape_at(1.3 * 0.501), 10u);
  EXPECT_EQ(shape_at(1.3 * 0.524), 10u);  // and not the one behind
  EXPECT_EQ(shape_at(1.3 * 0.526), 11u);
  EXPECT_EQ(shape_at(1.3 * 0.974), 19u);
  EXPECT_EQ(shape_at(1.3 * 0.976), 0u);  // round again
  EXPECT_EQ(shape_at(1.3 * 7.1), 2u);
  walker.speed = 0, walker.seconds = 0.25;
  EXPECT_EQ(shape_at(0), 25u);
}

/// What was baked another way round, and is said to be so, gives the same answers.
TEST(BakedCast, FacesWhereItIsSaidTo) {
  MadeUp recording(10);
  add_crowd(recording, 40, static_cast<int>(test::samples(40)));
  const std::vector<ClipSpeed> speeds{{"walk", 1.3}};
  std::vector<std::uint64_t> pairs;
  for (const double turn : {0.0, 1.1}) {
    const BakedShapes baked = baked_man(turn);
    const CharacterLibrary library = baked_library(baked, "people.bch", speeds);
    CheckOptions options;
    options.library = library, options.baked = &baked.set, options.facing = turn;
    const CheckSummary summary = check_of(recording, options);
    pairs.push_back(summary.all.overlapping_pairs);
    EXPECT_EQ(summary.poses.size(), 20u);
    options.facing += 1.5;
    EXPECT_NE(check_of(recording, options).all.overlapping_pairs, pairs.back());
  }
  EXPECT_NEAR(static_cast<double>(pairs[0]), static_cast<double>(pairs[1]), 1);  // by the outline's grid
}

TEST(BakedCast, RefusesWhatItCannotKnow) {
  BakedShapes baked = baked_man(0);
  const auto complaint_about = [&](const std::vector<ClipSpeed>& speeds) {
    return test::complaint([&] { baked_library(baked, "p.bch", speeds); });
  };
  EXPECT_EQ(complaint_about({{"hop", 1}}), "p.bch: has no clip called hop");
  EXPECT_EQ(
      complaint_about({{"walk", 0}}),
      "p.bch: does not say how fast people walk in its clips: --clip-speed has to, as walk=1.3; those of "
      "man.glb are walk, idle phone");
  baked.origins.origins.clear();
  EXPECT_EQ(complaint_about({}), "p.bch: does not say which clips and times its shapes show");
}

}  // namespace
}  // namespace bch::detail
