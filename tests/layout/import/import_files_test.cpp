// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>

#include <bch/import.hpp>

#include "tests/support/gltf_file.hpp"
#include "tests/support/temporary_folder.hpp"

// Which files are read beside the one that is given. What must not be read would be a good buffer, of a name that is not
// there beside the model: assimp looks there, too, for what it does not find.

namespace bch {
namespace {

namespace fs = std::filesystem;

class ImportFiles : public testing::Test {
 protected:
  ImportFiles() {
    fs::create_directory(models);
    fs::create_directory(models / "below");
    write_buffer(models / "buffer.bin");
    write_buffer(folder.file("secret.bin"));
    write_buffer(models / "below" / "secret.bin");
  }

  void write_buffer(const fs::path& file) const {
    std::ofstream stream(file, std::ios::binary);
    stream << gltf.buffer();
  }

  fs::path model(const std::string& uri) const { return folder.write("models/strip.gltf", gltf.text(uri)); }

  void expect_unread(const fs::path& file) const {
    try {
      import_character(file);
      ADD_FAILURE() << "read a file that is not beside " << file;
    } catch (const ImportError& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with(file.string() + ": ")) << error.what();
    }
  }

  const TemporaryFolder folder;
  const fs::path models = folder.file("models");
  const GltfFile gltf = SkinnedStrip().file();
};

TEST_F(ImportFiles, SiblingsAreRead) {
  EXPECT_EQ(import_character(model("buffer.bin")).report.triangles, 2u);
  EXPECT_EQ(import_character(model("../models/./buffer.bin")).report.triangles, 2u);
}

TEST_F(ImportFiles, SiblingsOfARelativePathAreRead) {
  const fs::path file = model("buffer.bin"), before = fs::current_path();
  fs::current_path(models);
  EXPECT_EQ(import_character(file.filename()).report.triangles, 2u);
  fs::current_path(before);
}

TEST_F(ImportFiles, NothingElseIs) {
  const std::string secret = folder.file("secret.bin");
  for (const std::string& uri :
       {std::string("../secret.bin"), std::string("below/secret.bin"), std::string("below/../../secret.bin"),
        secret, "file://" + secret, "/../../../../../../.." + secret, std::string("..\\\\secret.bin"),
        std::string("%2e%2e/secret.bin")})
    expect_unread(model(uri));
}

TEST_F(ImportFiles, LinksThatLeadElsewhereAreNotFollowed) {
  fs::create_symlink(folder.file("secret.bin"), models / "away.bin");
  fs::create_symlink(models / "buffer.bin", models / "here.bin");
  expect_unread(model("away.bin"));
  EXPECT_EQ(import_character(model("here.bin")).report.triangles, 2u);
}

/// The link is the file that is given; its siblings are those of the link.
TEST_F(ImportFiles, AModelMayBeALinkItself) {
  const fs::path there = folder.write("elsewhere.gltf", gltf.text("buffer.bin"));
  fs::create_symlink(there, models / "link.gltf");
  EXPECT_EQ(import_character(models / "link.gltf").report.triangles, 2u);
}

TEST_F(ImportFiles, PipesAreNotOpened) {
  fs::remove(models / "buffer.bin");
  ASSERT_EQ(mkfifo((models / "buffer.bin").c_str(), 0600), 0);
  expect_unread(model("buffer.bin"));  // else it would wait for a writer for ever
}

TEST_F(ImportFiles, HugeFilesAreRefused) {
  const fs::path file = model("buffer.bin");
  fs::resize_file(models / "buffer.bin", (std::uintmax_t{1} << 30) + 1);  // of holes
  expect_unread(file);
  fs::resize_file(file, (std::uintmax_t{1} << 30) + 1);
  try {
    import_character(file);
    ADD_FAILURE() << "accepted";
  } catch (const ImportError& error) {
    EXPECT_NE(std::string(error.what()).find("larger than 1 GiB"), std::string::npos) << error.what();
  }
}

TEST_F(ImportFiles, OtherFormatsAreNotRead) {
  // A triangle in Object File Format, which assimp could read.
  expect_unread(folder.write("models/triangle.off", "OFF\n3 1 3\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"));
  // Nor under a name of another format: readers look at the content, too.
  expect_unread(folder.write("models/triangle.obj", "OFF\n3 1 3\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"));
}

}  // namespace
}  // namespace bch
