// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <bch/import.hpp>

#include "tests/support/gltf_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace bch {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

class ImportFaults : public testing::Test {
 protected:
  TemporaryFolder folder;

  /// The message must be one line that names the file and the reason, and nothing may be printed.
  static void expect_error(const std::filesystem::path& file, const std::string& reason,
                           const ImportOptions& options = {}, std::filesystem::path named = {}) {
    if (named.empty()) named = file;
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    try {
      import_character(file, options);
      ADD_FAILURE() << file << " was accepted, not refused for '" << reason << "'";
    } catch (const ImportError& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      EXPECT_EQ(message.rfind(named.string() + ": ", 0), 0u) << message;
      EXPECT_NE(message.find(reason), std::string::npos) << message;
    }
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  }

  void expect_error(const std::string& name, const std::string& bytes, const std::string& reason) {
    expect_error(folder.write(name, bytes), reason);
  }

  /// One change to a good strip.
  template <class Change>
  void expect_strip_error(Change change, const std::string& reason) {
    SkinnedStrip strip;
    change(strip);
    expect_error("strip.gltf", strip.text(), reason);
  }
};

TEST_F(ImportFaults, FilesThatAreNone) {
  expect_error(folder.path() / "missing.glb", "no such file");
  expect_error(folder.path(), "is a directory");
  expect_error("empty.glb", "", "empty file");
  expect_error("text.glb", "This is\nnot a model.\n", "no glTF");
  expect_error("text.gltf", "This is\nnot a model.\n", "");
  expect_error("unknown.zzz", "This is\nnot a model.\n", "damaged, or of no known format");
}

TEST_F(ImportFaults, EveryTruncationIsRefused) {
  const std::string whole = SkinnedStrip().file().binary();
  for (const std::size_t size : {1ul, 4ul, 11ul, 12ul, 19ul, 20ul, 100ul, whole.size() / 2, whole.size() - 1})
    expect_error("cut.glb", whole.substr(0, size), "");
  const std::string text = SkinnedStrip().text();
  for (const std::size_t size : {1ul, 10ul, text.size() / 4, text.size() / 2, text.size() - 1})
    expect_error("cut.gltf", text.substr(0, size), "");
}

TEST_F(ImportFaults, MessageStaysOneLineForAnyFileName) {
  const std::filesystem::path file = folder.write("two\nlines.obj", "v 0 0 0\n");
  try {
    import_character(file);
    FAIL() << "accepted";
  } catch (const ImportError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

TEST_F(ImportFaults, NothingToDraw) {
  expect_strip_error([](SkinnedStrip& s) { s.mode = 0; }, "no triangles");
  expect_strip_error([](SkinnedStrip& s) { s.indices = {0, 77, 78}; }, "no triangles");
  expect_error("points.ply",
               "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
               "property float z\nend_header\n0 0 0\n",
               "no triangles");
}

TEST_F(ImportFaults, Positions) {
  expect_strip_error([](SkinnedStrip& s) { s.positions[4] = nan; }, "vertex 1 is not finite");
  expect_strip_error([](SkinnedStrip& s) { s.positions[11] = infinity; }, "vertex 3 is not finite");
  expect_strip_error([](SkinnedStrip& s) { s.positions[6] = 1e30f; }, "vertex 2 is absurdly far away");
  expect_strip_error([](SkinnedStrip& s) { s.positions[0] = 2e6f; }, "vertex 0 is absurdly far away");
}

TEST_F(ImportFaults, WeightsAndBones) {
  expect_strip_error([](SkinnedStrip& s) { s.weights.assign(16, 0); }, "zero weights");
  expect_strip_error([](SkinnedStrip& s) { s.weights[5] = nan; }, "gives vertex 1 the weight nan");
  expect_strip_error([](SkinnedStrip& s) { s.weights[5] = -0.5f; }, "gives vertex 1 the weight -0.5");
  expect_strip_error([](SkinnedStrip& s) { s.weights[8] = 1.01f; }, "gives vertex 2 the weight 1.01");
  expect_strip_error([](SkinnedStrip& s) { s.joints[13] = 2; }, "gives vertex 3 joint 2 of 2");
  expect_strip_error([](SkinnedStrip& s) { s.inverse_binds[12] = nan; }, "bone 'hips' of mesh 0 'strip'");
  expect_strip_error([](SkinnedStrip& s) { s.inverse_binds[16 + 3] = 2; }, "not affine");
  expect_strip_error([](SkinnedStrip& s) { s.inverse_binds[0] = 1e20f; }, "absurd transform");
}

TEST_F(ImportFaults, Clips) {
  expect_strip_error([](SkinnedStrip& s) { s.turns.assign(12, 0); }, "rotation key 0 is no rotation");
  expect_strip_error([](SkinnedStrip& s) { s.turns[5] = nan; }, "rotation key 1 is no rotation");
  expect_strip_error([](SkinnedStrip& s) { s.way[3] = infinity; }, "position key 1 is not finite");
  expect_strip_error([](SkinnedStrip& s) { s.way[3] = 1e9f; }, "'hips' absurdly far away");
  expect_strip_error([](SkinnedStrip& s) { s.times[1] = nan; }, "key 1 is at");
  expect_strip_error([](SkinnedStrip& s) { s.times[2] = 1e9f; }, "key 2 is at");
}

TEST_F(ImportFaults, Options) {
  const std::filesystem::path file = folder.write("strip.gltf", SkinnedStrip().text());
  for (const float scale : {0.0f, -1.0f, nan, infinity}) {
    ImportOptions options;
    options.scale = scale;
    expect_error(file, "is not a positive number", options);
  }
}

TEST_F(ImportFaults, ClipFiles) {
  const std::filesystem::path file = folder.write("strip.gltf", SkinnedStrip().text());
  const auto expect_clip_error = [&](const std::filesystem::path& clips, const std::string& reason) {
    ImportOptions options;
    options.clip_files = {clips};
    expect_error(file, reason, options, clips);
  };
  expect_clip_error(folder.path() / "missing.bvh", "no such file");
  expect_clip_error(folder.write("box.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "no clips");
  SkinnedStrip other;
  other.hips = "pelvis";
  other.head = "neck";
  expect_clip_error(folder.write("other.gltf", other.text()), "moves no joint that the character has");
  other = {};
  other.head_place = "\"translation\":[0.5,0,0]";
  expect_clip_error(folder.write("turned.gltf", other.text()), "joints are turned otherwise");
}

}  // namespace
}  // namespace bch
