// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <sys/stat.h>

#include "tests/support/gltf_file.hpp"
#include "tests/support/import_test.hpp"
#include "tests/support/test.hpp"

// What a file must not say, and which files are read beside the one that is given.

namespace bch {
namespace {

namespace fs = std::filesystem;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

class ImportFaults : public test::ImportTest {
 protected:
  const fs::path good = folder.write("good.gltf", SkinnedStrip().text());

  std::string complaint_of_clips(const fs::path& clips) const {
    ImportOptions options;
    options.clip_files = {clips};
    return complaint(good, options);
  }
};

TEST_F(ImportFaults, FilesThatAreNone) {
  EXPECT_EQ(complaint(folder.file("missing.glb")), "missing.glb: no such file");
  EXPECT_TRUE(complaint(folder.path()).ends_with("is a directory"));
  ImportOptions options;
  for (const float scale : {0.0f, -1.0f, nan, infinity}) {
    options.scale = scale;
    EXPECT_TRUE(complaint(good, options).ends_with("is not a positive number")) << scale;
  }
}

TEST_F(ImportFaults, EveryTruncationIsRefused) {
  const std::string whole = SkinnedStrip().file().binary(), text = SkinnedStrip().text();
  for (const std::size_t size : {1ul, 4ul, 11ul, 12ul, 19ul, 20ul, 100ul, whole.size() / 2, whole.size() - 1})
    EXPECT_NE(complaint("cut.glb", whole.substr(0, size)), "accepted") << size;
  for (const std::size_t size : {1ul, 10ul, text.size() / 4, text.size() / 2, text.size() - 1})
    EXPECT_NE(complaint("cut.gltf", text.substr(0, size)), "accepted") << size;
}

/// One change to a good strip.
TEST_F(ImportFaults, NumbersAndNames) {
  using Strip = SkinnedStrip;
  const std::pair<std::function<void(Strip&)>, const char*> cases[] = {
      {[](Strip& s) { s.mode = 0; }, "no triangles"},
      {[](Strip& s) { s.indices[1] = 77, s.indices[2] = 78, s.indices.resize(3); }, "no triangles"},
      {[](Strip& s) { s.positions[4] = nan; }, "vertex 1 is not finite"},
      {[](Strip& s) { s.positions[11] = infinity; }, "vertex 3 is not finite"},
      {[](Strip& s) { s.positions[6] = 1e30f; }, "vertex 2 is absurdly far away"},
      {[](Strip& s) { s.positions[0] = 2e6f; }, "vertex 0 is absurdly far away"},
      {[](Strip& s) { s.weights.assign(16, 0); }, "zero weights"},
      {[](Strip& s) { s.weights[5] = nan; }, "gives vertex 1 the weight nan"},
      {[](Strip& s) { s.weights[5] = -0.5f; }, "gives vertex 1 the weight -0.5"},
      {[](Strip& s) { s.weights[8] = 1.01f; }, "gives vertex 2 the weight 1.01"},
      {[](Strip& s) { s.joints[13] = 2; }, "gives vertex 3 joint 2 of 2"},
      {[](Strip& s) { s.inverse_binds[12] = nan; }, "bone 'hips' of mesh 0 'strip'"},
      {[](Strip& s) { s.inverse_binds[16 + 3] = 2; }, "not affine"},
      {[](Strip& s) { s.inverse_binds[0] = 1e20f; }, "absurd transform"},
      {[](Strip& s) { s.turns.assign(12, 0); }, "rotation key 0 is no rotation"},
      {[](Strip& s) { s.turns[5] = nan; }, "rotation key 1 is no rotation"},
      {[](Strip& s) { s.way[3] = infinity; }, "position key 1 is not finite"},
      {[](Strip& s) { s.way[3] = 1e9f; }, "'hips' absurdly far away"},
      {[](Strip& s) { s.times[1] = nan; }, "key 1 is at"},
      {[](Strip& s) { s.times[2] = 1e9f; }, "key 2 is at"}};
  for (const auto& [change, reason] : cases) {
    Strip strip;
    change(strip);
    EXPECT_TRUE(test::has(complaint("strip.gltf", strip.text()), reason));
  }
}

TEST_F(ImportFaults, ClipFiles) {
  EXPECT_EQ(complaint_of_clips(folder.file("missing.bvh")), "missing.bvh: no such file");
  EXPECT_TRUE(test::has(complaint_of_clips(folder.write("box.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")),
                        "box.obj: no clips"));
  SkinnedStrip other;
  other.hips = "pelvis", other.head = "neck";
  EXPECT_TRUE(test::has(complaint_of_clips(folder.write("other.gltf", other.text())),
                        "moves no joint that the character has"));
  other = {};
  other.head_place = "'translation':[0.5,0,0]";
  EXPECT_TRUE(test::has(complaint_of_clips(folder.write("turned.gltf", other.text())),
                        "joints are turned otherwise"));
}

/// What must not be read would be a good buffer, of a name that is not there beside the model: assimp looks there, too, for what it does not
/// find.
class ImportFiles : public test::ImportTest {
 protected:
  ImportFiles() {
    fs::create_directory(models);
    fs::create_directory(models / "below");
    for (const char* const name : {"models/buffer.bin", "secret.bin", "models/below/secret.bin"})
      folder.write(name, gltf.buffer());
  }

  fs::path model(const std::string& uri) const { return folder.write("models/strip.gltf", gltf.text(uri)); }
  bool reads(const fs::path& file) const { return import_character(file).report.triangles == 2; }
  void expect_unread(const std::string& uri) const {
    EXPECT_TRUE(complaint(model(uri)).starts_with("models/strip.gltf: ")) << uri;
  }

  const fs::path models = folder.file("models");
  const GltfFile gltf = SkinnedStrip().file();
};

TEST_F(ImportFiles, SiblingsAreReadAndNothingElseIs) {
  EXPECT_TRUE(reads(model("buffer.bin")));
  EXPECT_TRUE(reads(model("../models/./buffer.bin")));
  const fs::path before = fs::current_path();
  fs::current_path(models);
  EXPECT_TRUE(reads("strip.gltf"));
  fs::current_path(before);
  const std::string secret = folder.file("secret.bin");
  for (const std::string& uri :
       {std::string("../secret.bin"), std::string("below/secret.bin"), std::string("below/../../secret.bin"),
        secret, "file://" + secret, "/../../../../../../.." + secret, std::string("..\\\\secret.bin"),
        std::string("%2e%2e/secret.bin")})
    expect_unread(uri);
}

/// Of a model that is a link itself, siblings are those of the link.
TEST_F(ImportFiles, LinksThatLeadElsewhereAreNotFollowed) {
  fs::create_symlink(folder.file("secret.bin"), models / "away.bin");
  fs::create_symlink(models / "buffer.bin", models / "here.bin");
  expect_unread("away.bin");
  EXPECT_TRUE(reads(model("here.bin")));
  fs::create_symlink(folder.write("elsewhere.gltf", gltf.text("buffer.bin")), models / "link.gltf");
  EXPECT_TRUE(reads(models / "link.gltf"));
}

TEST_F(ImportFiles, PipesAreNotOpenedAndHugeFilesRefused) {
  fs::remove(models / "buffer.bin");
  ASSERT_EQ(mkfifo((models / "buffer.bin").c_str(), 0600), 0);
  expect_unread("buffer.bin");  // else it would wait for a writer for ever
  fs::remove(models / "buffer.bin");
  constexpr std::uintmax_t huge = (std::uintmax_t{1} << 30) + 1;  // of holes
  fs::resize_file(folder.write("models/buffer.bin", ""), huge);
  expect_unread("buffer.bin");
  fs::resize_file(model("buffer.bin"), huge);
  EXPECT_TRUE(test::has(complaint(models / "strip.gltf"), "larger than 1 GiB"));
}

}  // namespace
}  // namespace bch
