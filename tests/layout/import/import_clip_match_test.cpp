// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/clip_match.hpp"

#include "tests/support/bvh_file.hpp"
#include "tests/support/character_shapes.hpp"
#include "tests/support/gltf_file.hpp"
#include "tests/support/import_test.hpp"
#include "tests/support/test.hpp"

// Clips of another skeleton are refused, and those of the character's own skeleton are not.

namespace bch {
namespace {

using detail::importing::ClipMatch;
using detail::importing::mismatch;

std::vector<std::string> names(std::size_t count) {
  std::vector<std::string> list;
  for (std::size_t i = 0; i < count; ++i) list.push_back("joint " + std::to_string(i));
  return list;
}

/// Of so many channels so many match; the character has 20 joints.
ClipMatch match_of(std::size_t matched, std::size_t channels, std::size_t joints_in_file) {
  return {names(matched), names(channels - matched), 20, joints_in_file, 19, 2, 1};
}

TEST(ClipMatch, HalfOfTheChannelsOrOfTheJointsIsEnough) {
  EXPECT_EQ(mismatch(match_of(3, 6, 3)), "");
  EXPECT_EQ(mismatch(match_of(3, 31, 10)), "");  // a clip that moves cameras and helpers, too
  EXPECT_EQ(mismatch(match_of(1, 1, 2)), "");    // a part of the skeleton
  EXPECT_NE(mismatch(match_of(3, 7, 9)), "");
  EXPECT_NE(mismatch(match_of(3, 31, 3)), "");
}

TEST(ClipMatch, ThereHasToBeABoneToCompare) {
  ClipMatch match = match_of(3, 3, 20);
  match.bones_in_file = 0;
  EXPECT_TRUE(test::has(mismatch(match), "no bone"));
  match.bones = 0;  // a character of single joints has none
  EXPECT_EQ(mismatch(match), "");
}

TEST(ClipMatch, BonesHaveToPointTheSameWay) {
  ClipMatch match = match_of(20, 20, 20);
  match.alignment = 0.71;
  EXPECT_EQ(mismatch(match), "");
  match.alignment = 0.69;
  EXPECT_TRUE(test::has(mismatch(match), "turned otherwise"));
}

TEST(ClipMatch, ReasonsTellSharesAndAFewNames) {
  ClipMatch match = match_of(3, 31, 3);
  match.unmatched[0] = std::string(500, 'x');
  const std::string reason = mismatch(match);
  EXPECT_TRUE(reason.starts_with("3 of its 31 channels")) << reason;
  EXPECT_TRUE(test::has(reason, "joint 2;"));
  EXPECT_TRUE(test::has(reason, "and 23 more"));
  EXPECT_LT(reason.size(), 400u) << reason;
}

class ClipFiles : public test::ImportTest {
 protected:
  const std::filesystem::path strip = folder.write("strip.gltf", SkinnedStrip().text());

  /// A strip on the bone from "hips" to "head" gets the clip of a chain of joints.
  ImportOptions clip_of(const std::vector<std::string>& chain, bool force = false) const {
    ImportOptions options;
    options.clip_files = {folder.write("dance.bvh", test::BvhFile{.joints = chain}.text())};
    options.force_clips = force;
    return options;
  }
  ImportReport strip_with(const std::vector<std::string>& chain, bool force = false) const {
    return import_character(strip, clip_of(chain, force)).report;
  }

  void expect_refused(const std::vector<std::string>& chain, const std::vector<std::string>& words) const {
    const std::string line = complaint(strip, clip_of(chain));
    for (const std::string& word : words) EXPECT_TRUE(test::has(line, word));
    EXPECT_LT(line.size(), 1000u);
  }
};

TEST_F(ClipFiles, OfTheSameSkeletonAreTaken) {
  const ImportReport report = strip_with({"hips", "head"});
  EXPECT_EQ(report.clips.at(1).channels, 2u);
  EXPECT_FALSE(test::has_note(report, "reaches"));
  EXPECT_FALSE(test::has_note(report, "another skeleton"));
}

/// The joints have the same names, but nothing tells how large they are and how they are turned.
TEST_F(ClipFiles, WithoutABoneInCommonAreRefused) {
  expect_refused({"hips", "torso", "head"}, {"dance.bvh: ", "clip 'dance'", "2 of its 3 channels", "no bone",
                                             "hips, head", "torso", "--force-clips"});
  expect_refused({"head", "tail"}, {"1 of its 2 channels", "no bone"});
}

TEST_F(ClipFiles, OfWhichFewChannelsMatchAreRefused) {
  expect_refused({"head", "b", "c", "d", "e", "f", "g", "h", "i", "j"},
                 {"1 of its 10 channels", "less than half", "b, c, d, e, f and 4 more"});
}

TEST_F(ClipFiles, AreTakenByForceWithNotes) {
  const ImportReport report = strip_with({"head", "tail"}, true);
  EXPECT_EQ(report.clips.at(1).channels, 1u);
  EXPECT_TRUE(test::has_note(report, "clip 'dance' belongs to another skeleton, but --force-clips takes it"));
  // The head goes to where the file has it: 100 units up, 300 away.
  EXPECT_TRUE(test::has_note(report, "clip 'dance': a pose reaches 300."));
  EXPECT_THROW(strip_with({"tail"}, true), ImportError);
}

/// All characters with all clip files of the test data that are not known to be of one skeleton are refused, and the
/// others stay in reach.
TEST(ClipData, ClipsPlayOnTheirOwnSkeletonAlone) {
  const auto data = test::test_data();
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set: no real files to read";
  const std::string man = "generic_man_cmu.glb", arnaud = "native/arnaud.fbx",
                    biped = "rocketbox_male_2847_cmu.glb", woman = "native/Female_Adult_01.fbx",
                    other_man = "native/Male_Adult_01.fbx", walk = "native/clip_walk.fbx",
                    other_biped = "rocketbox_female_2841_cmu.glb", turn = "native/generic_man.fbx",
                    captured = "../mocap/07_01-walk.bvh", hero = "../nasty/huesitos.fbx";
  const std::set<std::pair<std::string, std::string>> fitting = {
      {man, walk},    {man, turn},          {arnaud, walk},     {arnaud, turn},
      {arnaud, man},  {biped, other_biped}, {biped, other_man}, {biped, woman},
      {woman, biped}, {woman, other_biped}, {woman, other_man}};
  for (const std::string& character : {man, arnaud, biped, woman})
    for (const std::string& file : {man, biped, woman, other_man, walk, other_biped, turn, captured, hero}) {
      if (file == character) continue;
      SCOPED_TRACE(character + " with " + file);
      ImportOptions options;
      options.clip_files = {*data / "characters" / file};
      try {
        const ImportReport report = import_character(*data / "characters" / character, options).report;
        EXPECT_TRUE(fitting.contains({character, file}));
        EXPECT_FALSE(test::has_note(report, "reaches"));
      } catch (const ImportError& error) {
        EXPECT_FALSE(fitting.contains({character, file})) << error.what();
      }
    }
}

}  // namespace
}  // namespace bch
