// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/clip_match.hpp"
#include "tests/support/bvh_file.hpp"
#include "tests/support/character_shapes.hpp"
#include "tests/support/collada_file.hpp"
#include "tests/support/fbx_text.hpp"
#include "tests/support/gltf_file.hpp"
#include "tests/support/import_test.hpp"
#include "tests/support/program_run.hpp"
#include "tests/support/test.hpp"

// What differs from format to format: units, axes, and clips that come in a file of their own.

namespace bch {
namespace {

using detail::importing::ClipMatch;
using detail::importing::mismatch;
using test::farthest_in_clips;
using test::has_note;

class ImportFormats : public test::ImportTest {
 protected:
  /// The strip with the clips of another file behind its own.
  ImportedCharacter strip_with(const std::string& name, const std::string& clips) const {
    ImportOptions options;
    options.clip_files = {folder.write(name, clips)};
    return import("strip.gltf", SkinnedStrip().text(), options);
  }

  /// Where a clip takes the root joint, in the frame of the file: the last key.
  static Eigen::Vector3f end_of_way(const Character& character, std::uint32_t clip) {
    for (const Channel& channel : character.clips.at(clip).channels)
      if (static_cast<std::int32_t>(channel.joint) == character.root_joint)
        return detail::to_eigen(channel.positions.back().value);
    throw std::logic_error("the root joint does not move");
  }

  /// The clip of another file moves the strip as its own does.
  static void expect_second_clip_as_first(const Character& character) {
    ASSERT_EQ(character.clips.size(), 2u);
    EXPECT_EQ(character.clips[0].seconds, character.clips[1].seconds);
    EXPECT_LT(farthest_in_clips(character, 0, character, 1), 1e-5f);
    EXPECT_TRUE(end_of_way(character, 1).isApprox(Eigen::Vector3f(3, 1, 0), 1e-5f));
  }
};

TEST_F(ImportFormats, FbxSaysItsAxisAndUnit) {
  FbxText fbx;
  fbx.nodes = {{"body", "Mesh"}};
  fbx.meshes = {{0, {{0, 0, 0}, {10, 0, 0}, {0, 30, 0}, {0, 0, 70}}}};
  fbx.unit = 2.54;
  const struct {
    int axis, sign;
    float height, lowest;
  } cases[] = {{0, 1, 10, 0}, {1, 1, 30, 0}, {2, 1, 70, 0}, {2, -1, 70, -70}, {1, -1, 30, -30}};
  for (const auto& [axis, sign, height, lowest] : cases) {
    fbx.up_axis = axis, fbx.up_sign = sign;
    const auto [character, report] = import("body.fbx", fbx.text());
    EXPECT_NEAR(report.height, height * 0.0254f, 1e-5f) << "axis " << axis;
    EXPECT_TRUE(has_note(report, "inches -> metres (FBX unit scale factor 2.54)"));
    EXPECT_GT(detail::to_eigen(character.to_ground).linear().determinant(), 0);
    detail::Skinner skinner(character);
    float bottom = 1e9f;
    for (const Vec3& position : skinner.pose({})) bottom = std::min(bottom, position.z);
    EXPECT_NEAR(bottom, lowest * 0.0254f, 1e-5f) << "axis " << axis << ", sign " << sign;
  }
  fbx.unit = -1;
  EXPECT_NE(complaint("body.fbx", fbx.text()), "accepted");
  fbx.unit = 1, fbx.up_axis = 7;
  EXPECT_NE(complaint("body.fbx", fbx.text()), "accepted");
}

TEST_F(ImportFormats, ColladaSaysItsAxisAndUnit) {
  const std::string text =
      test::collada_file_of(test::collada_geometry("g", "0 0 0 30 0 0 0 20 0 0 0 180"), "0.01");
  const ImportReport report = import("body.dae", text).report;
  EXPECT_NEAR(report.height, 1.8f, 1e-5f);
  EXPECT_TRUE(has_note(report, "z up"));
  EXPECT_FALSE(has_note(report, "y up"));
  ImportOptions options;
  options.up = ImportOptions::UpAxis::y;
  const ImportReport turned = import("body.dae", text, options).report;
  EXPECT_NEAR(turned.height, 0.2f, 1e-5f);
  EXPECT_TRUE(has_note(turned, "y up -> z up, as the caller says"));
}

/// A file that lies beside this one, its lines ended as the game's own tools do; assimp 5.2 loses every second header line (the frame
/// rate) of a file with bare line feeds.
std::string with_carriage_returns(const char* name) {
  std::string out;
  for (const char c : test::read_text(std::filesystem::path(__FILE__).parent_path() / name))
    out.append(c == '\n' ? "\r" : "").push_back(c);
  return out;
}

TEST_F(ImportFormats, SaysThatNodesShareAName) {
  std::string text = with_carriage_returns("strip.md5mesh");
  EXPECT_FALSE(has_note(import("distinct.md5mesh", text).report, "several nodes"));
  text.replace(text.find("\"head\""), 6, "\"hips\"");
  EXPECT_TRUE(has_note(import("shared.md5mesh", text).report, "several nodes are named 'hips'"));
}

TEST_F(ImportFormats, Md5WithItsMotionInAnotherFile) {
  ImportOptions options;
  options.clip_files = {folder.write("stroll.md5anim", with_carriage_returns("stroll.md5anim"))};
  const auto [character, report] = import("strip.md5mesh", with_carriage_returns("strip.md5mesh"), options);
  EXPECT_NEAR(report.height, 1.8288f, 1e-5f);
  EXPECT_TRUE(has_note(report, "inches -> metres, guessed"));
  ASSERT_EQ(character.clips.size(), 1u);
  EXPECT_EQ(character.clips[0].name, "stroll");
  EXPECT_NEAR(character.clips[0].seconds, 1.0f, 1e-6f);
  ASSERT_GE(character.root_joint, 0);
  EXPECT_EQ(character.joints[static_cast<std::size_t>(character.root_joint)].name, "hips");
  // 120 inches along x, and a quarter of a turn of the head about the vertical, which takes x into +-y.
  detail::Skinner skinner(character);
  const auto pose = skinner.pose({0, character.clips[0].seconds});
  float top_x = 0;
  float top_y = 0;
  for (std::uint32_t v = 0; v < pose.size(); ++v) {
    const std::uint32_t begin = character.influence_begin[v];
    const Bone& bone = character.bones[character.influences[begin].bone];
    if (character.influence_begin[v + 1] - begin > 1 || character.joints[bone.joint].name != "head") continue;
    top_x = pose[v].x;
    top_y = pose[v].y;
  }
  EXPECT_NEAR(top_x, 0, 1e-4f);
  EXPECT_NEAR(std::abs(top_y), 0.508f, 1e-4f);
}

TEST_F(ImportFormats, IqmGivesItsRestPose) {
  std::string bytes = "INTERQUAKEMODEL";
  bytes.push_back('\0');
  const auto add = [&](const std::vector<std::uint32_t>& words) {
    for (const std::uint32_t word : words)
      for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<char>(word >> shift & 0xff));
  };
  constexpr std::uint32_t header = 124;
  constexpr std::uint32_t text = header;
  constexpr std::uint32_t mesh = text + 4;
  constexpr std::uint32_t arrays = mesh + 24;
  constexpr std::uint32_t triangles = arrays + 20;
  constexpr std::uint32_t positions = triangles + 24;
  constexpr std::uint32_t size = positions + 48;
  add({2, size, 0, 4, text, 1, mesh, 1, 4, arrays, 2, triangles, 0});
  add(std::vector<std::uint32_t>(14, 0));
  add({0});                      // an empty name
  add({0, 0, 0, 4, 0, 2});       // one mesh of four vertices and two triangles
  add({0, 0, 7, 3, positions});  // floats, three a vertex
  add({0, 1, 3, 0, 3, 2});
  for (const float coordinate : {0.0f, 0.0f, 0.0f, 20.0f, 0.0f, 0.0f, 0.0f, 0.0f, 72.0f, 20.0f, 0.0f, 72.0f})
    add({std::bit_cast<std::uint32_t>(coordinate)});

  const auto [character, report] = import("post.iqm", bytes);
  EXPECT_EQ(report.triangles, 2u);
  EXPECT_NEAR(report.height, 1.8288f, 1e-5f);
  EXPECT_EQ(character.root_joint, -1);
  EXPECT_TRUE(has_note(report, "rest pose alone"));
}

TEST_F(ImportFormats, BvhPlaysOnASkeletonOfTheSameJointsWhateverItsUnit) {
  const auto [character, report] = strip_with("walk.bvh", test::BvhFile().text());
  EXPECT_TRUE(has_note(report, "positions scaled by 0.01"));
  EXPECT_EQ(report.clips.at(1).channels, 2u);
  EXPECT_FALSE(has_note(report, "reaches"));
  EXPECT_FALSE(has_note(report, "another skeleton"));
  expect_second_clip_as_first(character);
  EXPECT_NE(complaint("walk.bvh", test::BvhFile().text()), "accepted");  // alone
}

TEST_F(ImportFormats, ClipsMatchThroughNamespaces) {
  for (const std::string prefix : {"mixamorig:", "mixamorig1:", "mixamorig_", "Armature|"}) {
    SkinnedStrip source;
    source.hips = prefix + "hips";
    source.head = prefix + "head";
    const auto [character, report] = strip_with("stroll.gltf", source.text());
    EXPECT_EQ(report.clips.at(1).name, "stroll");
    EXPECT_EQ(report.clips.at(1).channels, 2u) << prefix;
    expect_second_clip_as_first(character);
  }
}

/// As modelling tools write it: an armature that turns z up to y up and centimetres to metres.
TEST_F(ImportFormats, ClipUnderATurnedAndScaledArmatureMovesAlike) {
  SkinnedStrip source;
  source.armature = "'rotation':[-0.70710678,0,0,0.70710678],'scale':[0.01,0.01,0.01],";
  source.hips_turn = "'rotation':[0.70710678,0,0,0.70710678],";
  source.head_place = "'translation':[0,50,0]";
  for (std::size_t key = 0; key < source.way.size(); key += 3) {
    const float up = source.way[key + 1];
    source.way[key] *= 100;
    source.way[key + 1] = -100 * source.way[key + 2];
    source.way[key + 2] = 100 * up;
  }
  expect_second_clip_as_first(strip_with("blend.gltf", source.text()).character);
}

TEST_F(ImportFormats, ClipOfATallerSkeletonIsScaledAndLimbsKeepTheirLength) {
  SkinnedStrip source;
  source.head_place = "'translation':[0,1,0]";
  for (float& coordinate : source.way) coordinate *= 2;
  expect_second_clip_as_first(strip_with("giant.gltf", source.text()).character);
}

// ---- Clips of another skeleton are refused, and those of the character's own skeleton are not.

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
  EXPECT_TRUE(test::has(reason, "less than half"));
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

/// The joints have the same names, but nothing tells how large they are and how they are turned.
TEST_F(ClipFiles, WithoutABoneInCommonAreRefused) {
  expect_refused({"hips", "torso", "head"}, {"dance.bvh: ", "clip 'dance'", "2 of its 3 channels", "no bone",
                                             "hips, head", "torso", "--force-clips"});
  expect_refused({"head", "tail"}, {"1 of its 2 channels", "no bone"});
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
