// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/bch_run.hpp"
#include "tests/support/character_shapes.hpp"
#include "tests/support/test.hpp"

// What all commands of the program have in common.

namespace bch::test {
namespace {

/// Of the programs beside it those that were built: not every build has them all.
TEST(Cli, TheOtherProgramsGiveTheSameExitCodes) {
  const std::filesystem::path folder = std::filesystem::path(BCH_PROGRAM).parent_path();
  for (const std::string name : {"bch_lab", "bch_ratios"}) {
    const std::string program = folder / name;
    if (!std::filesystem::exists(program)) continue;
    EXPECT_EQ(run_program(program, {"--help"}).code, 0) << name;
    for (const Arguments& wrong : {Arguments{"--nope"}, {"--agents", "0"}, {"--threads=99999999"}}) {
      const Ending run = run_program(program, wrong);
      EXPECT_EQ(run.code, 2) << name << ' ' << wrong.front();
      EXPECT_EQ(run.out, "");
      EXPECT_EQ(lines(run.err), 1u) << run.err;
    }
  }
}

TEST(Cli, OutputThatCannotBeWrittenIsReported) {
  expect_failure(bch({"--version"}, {}, {"/dev/full", {}}), 3, {"standard output"});
  expect_failure(bch({"crowd", "--json", "/nowhere/crowd.json"}), 3, {"/nowhere/crowd.json"});
  const TemporaryFolder folder;
  const std::string file = folder.write("a.csv", "old");
  expect_failure(bch({"crowd", "--json", file + "/crowd.json"}), 3, {"Not a directory"});
  EXPECT_EQ(read_text(file), "old");
}

TEST(Cli, FilesThatCrashTheImporterGiveThree) {
  const auto data = test::test_data();
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set";
  const std::string nasty = data->string() + "/nasty/";
  for (const char* name :
       {"OverflowingTriangleIndex.md5mesh", "OverflowingVertexIndex.md5mesh",
        "OverflowingWeightIndex.md5mesh", "InvalidMeshOffset.iqm", "InvalidBoneIndex.md5mesh"})
    expect_failure(bch({"inspect", nasty + name}), 3, {name});
  const TemporaryFolder folder;
  const std::string glb = read_text(*data / "characters/rocketbox_male_2847_cmu.glb").substr(0, 100'000);
  expect_failure(bch({"inspect", folder.write("truncated.glb", glb)}), 3, {"truncated.glb"});
}

TEST(Cli, InterruptLeavesNoFile) {
  const TemporaryFolder folder;
  const Ending run =
      bch({"crowd", "--poses", "20000", "--json", folder.file("a.json"), "--svg", folder.file("a.svg")}, {},
          {"", std::chrono::milliseconds(400)});
  EXPECT_EQ(run.code, 130);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err, "bch: interrupted\n");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Cli, FilesAreReplacedAndDevicesWrittenTo) {
  const TemporaryFolder folder;
  const std::string json_file = folder.write("a.json", "old");
  const Arguments crowd{"crowd", "--agents", "20", "--poses", "1", "--json", json_file, "--csv", "/dev/null"};
  EXPECT_EQ(bch(crowd).code, 0);
  EXPECT_TRUE(read_text(json_file).starts_with("{"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  // No temporary file stays behind.
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

}  // namespace
}  // namespace bch::test
