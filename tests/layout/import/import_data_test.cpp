// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/character_shapes.hpp"
#include "tests/support/import_test.hpp"
#include "tests/support/test.hpp"

// Real files, found through the environment variable BCH_TEST_DATA; what they hold is written in the
// SOURCES.md files beside them.

namespace bch {
namespace {

class ImportData : public testing::Test {
 protected:
  std::filesystem::path data;

  void SetUp() override {
    const auto folder = test::test_data();
    if (!folder) GTEST_SKIP() << "BCH_TEST_DATA is not set: no real files to read";
    data = *folder;
    ASSERT_TRUE(std::filesystem::is_directory(data)) << data;
  }

  std::filesystem::path character(const std::string& name) const { return data / "characters" / name; }

  /// The clips of native/, onto the skeleton they were made for.
  ImportOptions native_clips() const {
    ImportOptions options;
    for (const std::string name : {"atlas", "crackhead", "crossarms", "jog", "run", "walk"})
      options.clip_files.push_back(character("native/clip_" + name + ".fbx"));
    return options;
  }

  /// In every pose the character stands near its origin, upright, on the ground within a captured motion's
  /// error.
  static void expect_poses_in_place(const Character& c) {
    detail::Skinner skinner(c);
    for (std::uint32_t clip = 0; clip < c.clips.size(); ++clip)
      for (const float share : {0.0f, 0.13f, 0.29f, 0.5f, 0.61f, 0.77f, 0.92f, 1.0f}) {
        float reach = 0;
        Eigen::AlignedBox3f box;
        for (const Vec3& position : skinner.pose({clip, share * c.clips[clip].seconds})) {
          reach = std::max(reach, detail::to_eigen(position).head<2>().norm());
          box.extend(detail::to_eigen(position));
        }
        const std::string place = c.name + ", " + c.clips[clip].name + " at " + std::to_string(share);
        EXPECT_LT(reach, 1.0f) << place;
        EXPECT_GT(reach, 0.15f) << place;
        EXPECT_NEAR(box.min().z(), 0, 0.2f) << place;
        EXPECT_GT(box.max().z(), 0.7f) << place;
        EXPECT_LT(box.max().z(), 2.2f) << place;
      }
  }
};

std::string root_name(const Character& c) {
  return c.root_joint < 0 ? "" : c.joints[static_cast<std::size_t>(c.root_joint)].name;
}

TEST_F(ImportData, CapturedCharacters) {
  const struct {
    const char* name;
    std::size_t triangles, bones;
    float height;
    const char* root;
  } files[] = {{"rocketbox_female_2841_cmu.glb", 2841, 80, 1.743f, "Bip01"},
               {"rocketbox_male_2847_cmu.glb", 2847, 80, 1.816f, "Bip01"},
               {"rocketbox_female_cmu.glb", 8732, 80, 1.743f, "Bip01"},
               {"rocketbox_male_cmu.glb", 7440, 80, 1.824f, "Bip01"},
               {"generic_man_cmu.glb", 2811, 53, 1.828f, "Hips"}};
  for (const auto& file : files) {
    const auto [c, report] = import_character(character(file.name));
    validate(c);
    EXPECT_EQ(report.triangles, file.triangles) << file.name;
    EXPECT_EQ(report.bones, file.bones) << file.name;
    EXPECT_NEAR(report.height, file.height, 1e-3f) << file.name;
    EXPECT_EQ(report.dropped_faces, 0u) << file.name;
    EXPECT_EQ(root_name(c), file.root) << file.name;
    ASSERT_EQ(c.clips.size(), 14u) << file.name;
    float seconds = 0;
    for (const ImportReport::Clip& clip : report.clips) {
      seconds += clip.seconds;
      EXPECT_EQ(clip.channels, clip.channels_in_file) << clip.name;
    }
    EXPECT_NEAR(seconds, 209, 0.5f) << file.name;
    EXPECT_EQ(c.clips[6].name, "walk_turn_142_04");
    EXPECT_NEAR(c.clips[6].seconds, 31.07f, 0.01f);
    expect_poses_in_place(c);
  }
}

TEST_F(ImportData, NativeCharactersInCentimetres) {
  const struct {
    const char* name;
    std::size_t triangles, vertices, bones, clips;
    float height;
  } files[] = {{"native/Female_Adult_01.fbx", 8732, 4369, 80, 1, 1.743f},
               {"native/Male_Adult_01.fbx", 7440, 3745, 80, 1, 1.824f},
               {"native/generic_man.fbx", 2811, 1415, 53, 1, 1.828f},
               {"native/arnaud.fbx", 6670, 3337, 53, 0, 1.831f}};
  for (const auto& file : files) {
    const auto [c, report] = import_character(character(file.name));
    validate(c);
    EXPECT_EQ(report.triangles, file.triangles) << file.name;
    EXPECT_EQ(report.vertices, file.vertices) << file.name;
    EXPECT_EQ(report.bones, file.bones) << file.name;
    EXPECT_EQ(c.clips.size(), file.clips) << file.name;
    EXPECT_NEAR(report.height, file.height, 1e-3f) << file.name;
    expect_poses_in_place(c);
  }
}

TEST_F(ImportData, NativeClipsOntoTheirSkeleton) {
  const float seconds[] = {15.0f, 3.333f, 8.6f, 0.8f, 0.667f, 1.333f};
  for (const char* name : {"native/generic_man.fbx", "native/arnaud.fbx", "generic_man_cmu.glb"}) {
    const auto [c, report] = import_character(character(name), native_clips());
    validate(c);
    EXPECT_EQ(root_name(c), "Hips") << name;
    const std::size_t own = c.clips.size() - 6;
    for (std::size_t clip = 0; clip < 6; ++clip) {
      EXPECT_NEAR(c.clips[own + clip].seconds, seconds[clip], 1e-3f) << c.clips[own + clip].name;
      EXPECT_GE(report.clips[own + clip].channels, 53u) << c.clips[own + clip].name;
    }
    expect_poses_in_place(c);
  }
}

/// The glTF file is the FBX character in metres, so a clip must look the same on both.
TEST_F(ImportData, ClipIsIndependentOfTheUnitOfTheCharacter) {
  ImportOptions options;
  options.clip_files = {character("native/clip_walk.fbx")};
  const auto box = [&](const char* name, float time) {
    const Character c = import_character(character(name), options).character;
    detail::Skinner skinner(c);
    Eigen::AlignedBox3f all;
    for (const Vec3& position : skinner.pose({static_cast<std::uint32_t>(c.clips.size() - 1), time}))
      all.extend(detail::to_eigen(position));
    return all;
  };
  for (const float time : {0.0f, 0.4f, 0.9f, 1.3f}) {
    const Eigen::AlignedBox3f a = box("native/generic_man.fbx", time), b = box("generic_man_cmu.glb", time);
    EXPECT_LT((a.min() - b.min()).norm(), 5e-3f) << time;
    EXPECT_LT((a.max() - b.max()).norm(), 5e-3f) << time;
  }
}

/// These captures are known to turn by more than a quarter: the shape must turn with them.
TEST_F(ImportData, PosesKeepTheirYaw) {
  const Character c = import_character(character("rocketbox_male_2847_cmu.glb")).character;
  detail::Skinner skinner(c);
  const auto clip = static_cast<std::uint32_t>(std::ranges::find(c.clips, "walk_turn_142_04", &Clip::name) -
                                               c.clips.begin());
  ASSERT_LT(clip, c.clips.size());
  // Two vertices far apart across the body at rest.
  const auto rest = skinner.pose({});
  const auto [left, right] = std::ranges::minmax_element(rest, {}, &Vec3::x);
  const auto from = static_cast<std::size_t>(left - rest.begin()),
             to = static_cast<std::size_t>(right - rest.begin());
  float most_turned = 1;
  Eigen::Vector2f first = Eigen::Vector2f::Zero();
  for (float time = 0; time < c.clips[clip].seconds; time += 0.25f) {
    const auto pose = skinner.pose({clip, time});
    const Eigen::Vector2f way =
        (detail::to_eigen(pose[to]) - detail::to_eigen(pose[from])).head<2>().normalized();
    if (time == 0) first = way;
    most_turned = std::min(most_turned, first.dot(way));
  }
  EXPECT_LT(most_turned, -0.8f);
}

void expect_refused(const std::filesystem::path& file, const std::string& reason,
                    const ImportOptions& options = {}) {
  EXPECT_TRUE(test::has(test::complaint<ImportError>([&] { import_character(file, options); }), reason))
      << file;
}

/// Files that bring assimp itself down, or make it read past the end of what it has: for a child process.
bool breaks_assimp(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  return name.starts_with("Overflowing") || name == "OutOfMemory.off" || name == "InvalidMeshOffset.iqm" ||
         name == "InvalidBoneIndex.md5mesh";
}

TEST_F(ImportData, NastyFilesAreReadOrRefusedAndNothingElse) {
  std::size_t read = 0;
  std::size_t refused = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data / "nasty")) {
    if (!entry.is_regular_file() || breaks_assimp(entry.path())) continue;
    SCOPED_TRACE(entry.path().string());
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    try {
      const Character c = import_character(entry.path()).character;
      EXPECT_NO_THROW(validate(c));
      ++read;
    } catch (const ImportError& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      EXPECT_EQ(message.rfind(entry.path().string() + ": ", 0), 0u) << message;
      ++refused;
    } catch (const std::exception& error) {
      ADD_FAILURE() << "left the importer: " << error.what();
    }
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  }
  EXPECT_GE(read, 15u);
  EXPECT_GE(refused, 13u);
}

TEST_F(ImportData, NastyFilesAreRefusedForTheRightReason) {
  const std::pair<const char*, const char*> files[] = {
      {"BoxWithInfinites.glb", "vertex 0 is not finite"},
      {"empty.obj", "empty file"},
      {"../gltf/required_unknown.gltf", "extension 'EXT_foo'"},
      {"box_UTF16BE.obj", "text in UTF-16"},
      {"points.ply", "no triangles"},
      {"testline.obj", "no triangles"},
      {"nosurfaces.ac", "no known format"},
      {"IncorrectVertexArrays/Cube.bin", "no known format"}};
  for (const auto& [name, reason] : files) expect_refused(data / "nasty" / name, reason);
}

TEST_F(ImportData, OddFilesKeepWhatIsGood) {
  const std::pair<const char*, std::size_t> files[] = {{"malformed2.obj", 10},
                                                       {"IndexOutOfRange/IndexOutOfRange.gltf", 11},
                                                       {"testmixed.obj", 12},
                                                       {"IncorrectVertexArrays/Cube.gltf", 46},
                                                       {"triangle_with_empty_solid.stl", 1},
                                                       {"sphereWithHole.stl", 285},
                                                       {"Spider_ascii.stl", 1368},
                                                       {"human.zae", 28796}};
  for (const auto& [name, triangles] : files)
    EXPECT_EQ(import_character(data / "nasty" / name).report.triangles, triangles) << name;
}

}  // namespace
}  // namespace bch
