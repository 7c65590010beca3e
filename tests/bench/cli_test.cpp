// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/bch_run.hpp"
#include "tests/support/character_shapes.hpp"
#include "tests/support/temporary_folder.hpp"

// What all commands of the program have in common, and `bch inspect`.

namespace bch::test {
namespace {

TEST(Cli, HelpAndVersionGoToStandardOutput) {
  for (const Arguments& arguments : {Arguments{"--help"},
                                     {"--version"},
                                     {"bake", "--help"},
                                     {"crowd", "--help"},
                                     {"inspect", "--help"},
                                     {"query", "--help"},
                                     {"report", "--help"}}) {
    const Ending run = bch(arguments);
    EXPECT_EQ(run.code, 0);
    EXPECT_EQ(run.err, "");
    EXPECT_NE(run.out, "");
    EXPECT_EQ(run.out.back(), '\n');
    std::istringstream text(run.out);
    for (std::string line; std::getline(text, line);) EXPECT_LE(line.size(), 120u) << line;
  }
}

TEST(Cli, RepeatableOptionsDoNotLookLikeLists) {
  for (const char* command : {"bake", "crowd", "inspect", "query", "report"})
    for (const char* option : {"--clips FILE .", "--character FILE .", "--experiment NAME ."})
      EXPECT_EQ(bch({command, "--help"}).out.find(option), std::string::npos) << command;
}

TEST(Cli, UsageErrorsGiveTwo) {
  const std::pair<Arguments, std::string> cases[] = {
      {{}, "subcommand"},
      {{"dance"}, "dance"},
      {{"crowd", "extra"}, "extra"},
      {{"crowd", "--agents", "0"}, "--agents"},
      {{"crowd", "--agents", "2.5"}, "2.5"},
      {{"crowd", "--density", "nan"}, "nan"},
      {{"crowd", "--density", "1.0abc"}, "1.0abc"},
      {{"crowd", "--seed", "-1"}, "-1"},
      {{"crowd", "--depths", "3,0"}, "ascend"},
      {{"crowd", "--depths", "0,,3"}, "--depths"},
      {{"crowd", "--isa", "mmx"}, "mmx"},
      {{"crowd", "--semantics", "fuzzy"}, "fuzzy"},
      {{"crowd", "--svg-depth", "6"}, "--svg"},
      {{"crowd", "--svg", "x.svg", "--svg-depth", "5"}, "--svg-depth"},
      {{"crowd", "--json", "-"}, "'-' is not a file"},
      {{"crowd", "--json", "x.json", "--csv", "./x.json"}, "--json and --csv: "},
      {{"crowd", "--csv", "x.svg", "--svg", "x.svg"}, "--csv and --svg: "},
      {{"crowd", "--character", "x.bch", "--json", "x.json", "--csv", "x.json"}, "--json and --csv: "},
      {{"inspect", "default:male", "--shape", "0", "--svg", "x.svg", "--json", "x.svg"},
       "--json and --svg: "},
      {{"stability", "--json", "x.csv", "--csv", "x.csv"}, "--csv and --json: "},
      {{"crowd", "--seed", "1e99"}, "from 0 to 18446744073709551615"},
      {{"crowd", "--clips", "a.bvh", "b.bvh"}, "b.bvh"},
      {{"crowd", "--character", "default:dog"}, "default:dog"},
      {{"crowd", "--clips", "walk.bvh"}, "--clips"},
      {{"inspect", "x.glb", "--force-clips"}, "--clips"},
      {{"inspect", "x.bch", "--clips", "walk.bvh", "--force-clips"}, "--clips"},
      {{"bake", "default:male"}, "--output"},
      {{"bake", "-o", "x.bch"}, "FILE"},
      {{"bake", "default:male", "-o", "x.bch", "--poses", "3", "--rate", "2"}, "--rate"},
      {{"bake", "default:male", "-o", "x.bch", "--depths", "3,0"}, "ascend"},
      {{"crowd", "--character", "x.bch", "--poses", "3"}, "--poses"},
      {{"crowd", "--character", "x.bch", "--svg", "x.svg"}, "--svg"},
      {{"crowd", "--character", "x.bch", "--character", "default:male"}, "alone"},
      {{"query", "x.bch", "a.csv", "p.csv", "--depths", "0"}, "--depths"},
      {{"inspect", "x.bch", "--shape", "0"}, "--shape"},
      {{"inspect"}, "FILE"},
      {{"inspect", "default:male", "--clip", "walk"}, "--time"},
      {{"inspect", "default:male", "--svg", "x.svg"}, "--svg"},
      {{"query", "default:male", "agents.csv"}, "PAIRS.csv"},
      {{"query", "default:male", "a.csv", "p.csv", "--all-pairs"}, "--all-pairs"},
      {{"report"}, "--out"},
      {{"report", "--out", "x", "--experiment", "guess"}, "guess"},
      {{"report", "--out", "x", "--page", "--quick"}, "--quick"},
  };
  for (const auto& [arguments, word] : cases) expect_failure(bch(arguments), 2, {word});
}

/// Of the programs beside it those that were built: not every build has them all.
TEST(Cli, TheOtherProgramsGiveTheSameExitCodes) {
  const std::filesystem::path folder = std::filesystem::path(BCH_PROGRAM).parent_path();
  for (const std::string name : {"bch_live_crowd", "bch_ratios"}) {
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
  expect_failure(bch({"report", "--out", "/dev/null/report"}), 3, {"/dev/null/report"});
  const TemporaryFolder folder;
  const std::string file = folder.write("a.csv", "old");
  for (const char* command : {"report", "stability"})
    for (const std::string& out : {file, std::string("/dev/null")})
      expect_failure(bch({command, "--out", out, "--quick"}), 3, {out + ": ", "Not a directory"});
  expect_failure(bch({"crowd", "--json", file + "/crowd.json"}), 3, {"Not a directory"});
  EXPECT_EQ(read_text(file), "old");
}

struct BadFile {
  const char* name;
  std::string content;
};

std::vector<BadFile> bad_files() {
  using namespace std::string_literals;
  // A header that promises more than there is.
  std::string glb = "glTF\2\0\0\0\0\x10\0\0\x80\0\0\0JSON{\"asset\""s;
  if (const auto data = test::test_data())
    glb = read_text(*data / "characters/rocketbox_male_2847_cmu.glb").substr(0, 100000);
  return {{"empty.glb", ""},
          {"truncated.glb", glb},
          {"text.glb", "This is a letter, not a character.\n"},
          {"points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"},
          {"nan.obj", "v nan 0 0\nv 1 0 0\nv 0 nan 1\nv 0 1 1\nf 1 2 3\nf 1 3 4\n"},
          {"letter.txt", "Dear reader\n"}};
}

TEST(Cli, BadCharacterFilesGiveThreeAndOneLine) {
  const TemporaryFolder folder;
  for (const BadFile& bad : bad_files()) {
    SCOPED_TRACE(bad.name);
    expect_failure(bch({"inspect", folder.write(bad.name, bad.content)}), 3, {bad.name});
  }
  expect_failure(bch({"inspect", folder.file("missing.glb")}), 3, {"missing.glb: "});
  expect_failure(bch({"crowd", "--character", folder.file("missing.glb")}), 3, {"missing.glb: "});
}

TEST(Cli, EveryBadFileOfSeveralIsNamed) {
  const TemporaryFolder folder;
  const std::string first = folder.write("first.glb", "no model"),
                    second = folder.write("second.obj", "v 0 0 0\n");
  const std::string file = folder.file("a.bch");
  const Ending bake = bch({"bake", first, "default:male", second, "--poses", "1", "-o", file});
  const Ending crowd = bch({"crowd", "--character", first, "--character", second});
  for (const Ending& run : {bake, crowd}) {
    EXPECT_EQ(run.code, 3);
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(lines(run.err), 2u) << run.err;
    EXPECT_NE(run.err.find("bch: " + first + ": "), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("\nbch: " + second + ": "), std::string::npos) << run.err;
  }
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(Cli, FilesThatCrashTheImporterGiveThree) {
  const auto data = test::test_data();
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set";
  const std::string nasty = data->string() + "/nasty/";
  for (const char* name :
       {"OverflowingTriangleIndex.md5mesh", "OverflowingVertexIndex.md5mesh",
        "OverflowingWeightIndex.md5mesh", "InvalidMeshOffset.iqm", "InvalidBoneIndex.md5mesh"})
    expect_failure(bch({"inspect", nasty + name}), 3, {name});
}

TEST(Cli, ChoicesThatTheFileDoesNotHaveGiveThree) {
  expect_failure(bch({"inspect", "default:male", "--shape", "100"}), 3, {"100"});
  expect_failure(bch({"inspect", "default:male", "--clip", "fly", "--time", "0"}), 3, {"fly"});
  expect_failure(bch({"inspect", "default:male", "--clip", "walk", "--time", "99"}), 3, {"99"});
}

TEST(Cli, InspectTellsEverythingOfAShape) {
  const TemporaryFolder folder;
  const std::string json_file = folder.file("shape.json"), svg_file = folder.file("shape.svg");
  const Ending run =
      bch({"inspect", folder.write("box.obj", box), "--shape", "0", "--json", json_file, "--svg", svg_file},
          as_metres);
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("12 triangles"), std::string::npos) << run.out;
  const auto json = read_json(json_file);
  EXPECT_EQ(json["character"]["triangles"], 12);
  EXPECT_NEAR(json["character"]["height_m"].get<double>(), 1.8, 1e-6);
  const auto& shape = json["shape"];
  ASSERT_EQ(shape["outline"]["contours"].size(), 1u);
  EXPECT_EQ(shape["outline"]["contours"][0].size(), 4u);
  EXPECT_NEAR(shape["outline"]["area_m2"].get<double>(), 0.15, 1e-5);
  // The single cylinder: a disc around the box.
  EXPECT_NEAR(shape["depths"][0]["mean_radius_m"].get<double>(), 0.29155, 1e-4);
  EXPECT_NEAR(shape["depths"][0]["area_m2"].get<double>(), 0.26704, 1e-4);
  for (const auto& depth : shape["depths"]) EXPECT_GT(depth["area_m2"], 0);

  const std::string svg = read_text(svg_file);
  EXPECT_TRUE(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
  for (std::size_t depth = 0; depth < shape["depths"].size(); ++depth)
    EXPECT_NE(svg.find("id=\"depth-" + std::to_string(depth) + "\""), std::string::npos);
}

TEST(Cli, InspectListsTheSampledShapes) {
  const TemporaryFolder folder;
  const std::string json_file = folder.file("table.json");
  const Ending run = bch({"inspect", "default:female", "--poses", "4", "--json", json_file});
  ASSERT_EQ(run.code, 0) << run.err;
  const auto json = read_json(json_file);
  ASSERT_EQ(json["shapes"].size(), 4u);
  EXPECT_EQ(json["shapes"][3]["shape"], 3);
  EXPECT_EQ(json["character"]["clip_seconds"], 212);
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
