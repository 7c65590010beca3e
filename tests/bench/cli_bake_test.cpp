// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "layout/format/shape_set_view.hpp"
#include "tests/support/baked_bytes.hpp"
#include "tests/support/bch_run.hpp"
#include "tests/support/temporary_folder.hpp"

// `bch bake`, and the other commands on the files that it writes.

namespace bch::test {
namespace {

/// A row for each agent of a lattice, in one of so many shapes and levels.
std::string mixed_agents(int side, int shapes, int levels) {
  std::ostringstream csv;
  csv << "id,shape,x,y,heading,level\n";
  for (int i = 0; i < side * side; ++i)
    csv << i << ',' << i % shapes << ',' << 0.43 * (i % side) << ',' << 0.41 * (i / side) << ',' << 0.7 * i
        << ',' << i % levels << '\n';
  return csv.str();
}

TEST(Cli, BakedShapesAnswerLikeTheirCharacter) {
  const TemporaryFolder folder;
  const std::string baked = folder.file("female.bch"),
                    agents = folder.write("agents.csv", mixed_agents(9, 5, 3));
  const Arguments how{"--poses", "5", "--depths", "0,4,all", "--semantics", "solid"};
  const Ending bake = bch({"bake", "default:female", "-o", baked}, how);
  ASSERT_EQ(bake.code, 0) << bake.err;
  EXPECT_EQ(bake.err, "");
  EXPECT_NE(bake.out.find("0, 4, all"), std::string::npos) << bake.out;
  const Ending expected = bch({"query", "default:female", agents, "--all-pairs"}, how);
  for (const Arguments& semantics : {Arguments{}, Arguments{"--semantics", "solid"}}) {
    const Ending run = bch({"query", baked, agents, "--all-pairs"}, semantics);
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(run.out, expected.out);
  }
  EXPECT_GT(lines(expected.out), 20u);
}

TEST(Cli, BakeTellsTheNotesOfTheImport) {
  const TemporaryFolder folder;
  const std::string obj = folder.write("box.obj", box);
  const Ending inspect = bch({"inspect", obj}), bake = bch({"bake", obj, "-o", folder.file("box.bch")});
  ASSERT_EQ(inspect.code, 0) << inspect.err;
  ASSERT_EQ(bake.code, 0) << bake.err;
  std::istringstream in(inspect.out);
  std::size_t notes = 0;
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("  note      ")) continue;
    ++notes;
    EXPECT_NE(bake.out.find("  note      " + obj + ": " + line.substr(12) + "\n"), std::string::npos)
        << bake.out;
  }
  EXPECT_GT(notes, 0u) << inspect.out;
}

TEST(Cli, InspectVerifiesABakedFile) {
  const TemporaryFolder folder;
  for (const Arguments& how :
       {Arguments{"--semantics", "solid"}, Arguments{"--depths", "0,3"}, Arguments{"--depths", "0"}}) {
    const std::string file = folder.file("man.bch");
    ASSERT_EQ(bch({"bake", "default:male", "--poses", "6", "-o", file}, how).code, 0);
    const Ending run = bch({"inspect", "--verify", file});
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_NE(run.out.find("  verified  "), std::string::npos) << run.out;
    EXPECT_EQ(bch({"inspect", file}).out.find("verified"), std::string::npos);
  }
  expect_failure(bch({"inspect", "default:male", "--verify"}), 2, {"--verify", "baked"});
}

TEST(Cli, VerifyNamesALie) {
  BakedBytes bytes(ShapeSet(few_shapes(), {.outlines = true}), origins_of(3));
  bytes.section<detail::Profile>(detail::baked::Section::profiles)[1].sectors[4].outer -= 0.01f;
  bytes.seal();
  const TemporaryFolder folder;
  const std::string file = folder.write("lie.bch", bytes.text());
  EXPECT_EQ(bch({"inspect", file}).code, 0);
  expect_failure(bch({"inspect", file, "--verify"}), 3,
                 {"lie.bch: shape 1: profiles: ", "outer of sector 4"});
}

TEST(Cli, BakedCrowdIsTheCrowdOfItsCharacters) {
  const TemporaryFolder folder;
  const std::string baked = folder.file("two.bch"), json_file = folder.file("crowd.json");
  ASSERT_EQ(bch({"bake", "default:male", "default:female", "--poses", "5", "-o", baked}).code, 0);
  const auto report = [&](const Arguments& source) {
    const Ending run = bch({"crowd", "--agents", "200", "--json", json_file}, source);
    EXPECT_EQ(run.code, 0) << run.err;
    auto levels = read_json(json_file)["levels"];
    for (auto& level : levels) level.erase("nanoseconds_per_pair"), level.erase("runs");
    return levels;
  };
  EXPECT_EQ(report({"--character", baked}), report({"--poses", "5"}));
  const std::string discs = folder.file("discs.bch");
  ASSERT_EQ(bch({"bake", "default:male", "--poses", "2", "--leaves", "discs", "-o", discs}).code, 0);
  EXPECT_LT(std::filesystem::file_size(discs), std::filesystem::file_size(baked) / 5);
  EXPECT_EQ(bch({"crowd", "--agents", "20", "--character", discs}).code, 0);
  expect_failure(bch({"crowd", "--character", discs, "--semantics", "solid"}), 3,
                 {"discs.bch: ", "--semantics solid"});
  expect_failure(bch({"crowd", "--character", discs, "--leaves", "segments"}), 3,
                 {"discs.bch: ", "--leaves segments"});
}

TEST(Cli, InspectDescribesABakedFile) {
  const TemporaryFolder folder;
  const std::string baked = folder.file("male.bch"), json_file = folder.file("male.json");
  ASSERT_EQ(
      bch({"bake", "default:male", "--rate", "0.1", "--threshold", "0.02", "--depths", "3", "-o", baked})
          .code,
      0);
  const Ending run = bch({"inspect", baked, "--json", json_file});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("20 mm"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("walk slow"), std::string::npos) << run.out;
  const auto json = read_json(json_file);
  EXPECT_EQ(json["depths"], nlohmann::json({"3"}));
  EXPECT_EQ(json["threshold_m"], 0.02);
  EXPECT_EQ(json["solid"], false);
  EXPECT_EQ(json["exact_leaves"], false);
  ASSERT_EQ(json["shapes"].size(), json["shape_count"]);
  EXPECT_EQ(json["shapes"][0]["character"], "default:male");
  EXPECT_EQ(json["shapes"][0]["clip"], "walk");
  EXPECT_EQ(json["shapes"][1]["seconds"], 10);
  EXPECT_EQ(json["shapes"][0]["discs"], 8);
}

TEST(Cli, BakedBytesDoNotDependOnThreads) {
  const TemporaryFolder folder;
  const auto bake = [&](const char* threads) {
    const std::string file = folder.file("shapes.bch");
    EXPECT_EQ(bch({"bake", "default:male", "--poses", "40", "--threads", threads, "-o", file}).code, 0);
    return read_text(file);
  };
  const std::string one = bake("1");
  EXPECT_FALSE(one.empty());
  for (const char* threads : {"2", "3", "8"}) EXPECT_EQ(bake(threads), one) << threads;
}

TEST(Cli, BadBakedFilesGiveThreeAndOneLine) {
  const TemporaryFolder folder;
  const std::string baked = folder.file("male.bch");
  ASSERT_EQ(bch({"bake", "default:male", "--poses", "1", "-o", baked}).code, 0);
  const std::string text = read_text(baked);
  std::string flipped = text;
  flipped[text.size() / 2] ^= 4;
  std::string newer = text;
  newer[12] = 7;
  const std::pair<std::string, const char*> cases[] = {{"", "too few"},
                                                       {text.substr(0, 3000), "3000"},
                                                       {flipped, "wrong checksum"},
                                                       {newer, "version 7"},
                                                       {std::string(5000, 'x'), "not a baked file"}};
  const std::string agents = folder.write("agents.csv", four_agents);
  for (const auto& [content, word] : cases) {
    const std::string bad = folder.write("bad.bch", content);
    expect_failure(bch({"inspect", bad}), 3, {"bad.bch: ", word});
    expect_failure(bch({"crowd", "--character", bad}), 3, {"bad.bch: ", word});
    expect_failure(bch({"query", bad, agents, "--all-pairs"}), 3, {"bad.bch: ", word});
  }
  expect_failure(bch({"inspect", folder.file("missing.bch")}), 3, {"missing.bch: "});
}

TEST(Cli, BakedFilesOfAnySizeGiveThreeAndOneLine) {
  const TemporaryFolder folder;
  const std::string file = folder.write("huge.bch",
                                        "\x89"
                                        "BCH\r\n");
  std::error_code failed;
  std::filesystem::resize_file(file, std::uintmax_t{1} << 40, failed);
  if (failed) GTEST_SKIP() << "no file of 1 TiB: " << failed.message();
  expect_failure(bch({"inspect", file}), 3, {file, "not a baked file"});
  expect_failure(bch({"crowd", "--character", file}), 3, {file, "not a baked file"});
}

TEST(Cli, BakedFilesAreKnownByTheirEnding) {
  const TemporaryFolder folder;
  for (const char* name : {"p.txt", "p", "p.bch.gz", "bch"}) {
    const std::string file = folder.file(name);
    expect_failure(bch({"bake", "default:male", "-o", file}), 2, {file, ".bch"});
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  const std::string upper = folder.file("P.BCH");
  ASSERT_EQ(bch({"bake", "default:male", "--poses", "1", "-o", upper}).code, 0);
  EXPECT_NE(bch({"inspect", upper}).out.find("baked shapes"), std::string::npos);
}

TEST(Cli, BakedFilesKeepClipsAsMovingDiscs) {
  const TemporaryFolder folder;
  const std::string baked = folder.file("p.bch"), plain = folder.file("q.bch"), json = folder.file("p.json"),
                    svg = folder.file("p.svg");
  const Arguments few{"--poses", "3"};
  // A clip that is named twice is kept once.
  const Ending bake =
      bch({"bake", "default:male", "--animated", "idle think", "--animated", "idle think", "-o", baked}, few);
  ASSERT_EQ(bake.code, 0) << bake.err;
  EXPECT_NE(bake.out.find("  animated  default:male: idle think (6.00 s, "), std::string::npos) << bake.out;
  EXPECT_EQ(bch({"inspect", baked, "--verify", "--json", json}).code, 0);
  const auto clips = read_json(json)["animated"];
  ASSERT_EQ(clips.size(), 1u);
  EXPECT_EQ(clips[0]["character"], "default:male");
  EXPECT_EQ(clips[0]["clip"], "idle think");
  EXPECT_GT(clips[0]["chunks"], 40);
  // The poses are those of a file without clips.
  ASSERT_EQ(bch({"bake", "default:male", "-o", plain}, few).code, 0);
  const Arguments all{"--all-pairs"};
  const std::string agents = folder.write("agents.csv", mixed_agents(5, 3, 1));
  EXPECT_EQ(bch({"query", baked, agents}, all).out, bch({"query", plain, agents}, all).out);
  // What the file has is what is made of the character.
  const Arguments at{"--animated", "--clip", "idle think", "--time", "0.4", "--json", json, "--svg", svg};
  const Ending shown = bch({"inspect", baked}, at);
  ASSERT_EQ(shown.code, 0) << shown.err;
  EXPECT_NE(shown.out.find("idle think as moving discs"), std::string::npos) << shown.out;
  const auto from_file = read_json(json)["animated"];
  ASSERT_EQ(bch({"inspect", "default:male"}, at).code, 0);
  EXPECT_EQ(read_json(json)["animated"], from_file);
  EXPECT_GT(from_file["at"]["discs"].size(), 50u);
  std::ifstream picture(svg);
  const std::string drawn{std::istreambuf_iterator<char>(picture), {}};
  EXPECT_GT(std::count(drawn.begin(), drawn.end(), 'Z'), 5);
  EXPECT_NE(drawn.find("class=\"outline\""), std::string::npos);
  EXPECT_EQ(drawn.find("nan"), std::string::npos);
}

TEST(Cli, BakedClipsAreCutAsTheShapesAre) {
  const TemporaryFolder folder;
  const std::string baked = folder.file("p.bch"), json = folder.file("p.json"), svg = folder.file("p.svg");
  const Arguments slices{"--slices", "1,2.5"};
  const Ending bake =
      bch({"bake", "default:male", "--animated", "idle think", "-o", baked, "--poses", "1"}, slices);
  ASSERT_EQ(bake.code, 0) << bake.err;
  EXPECT_NE(bake.out.find("idle think (6.00 s, 3 slabs, "), std::string::npos) << bake.out;
  const Arguments at{"--animated", "--clip", "idle think", "--time", "0.4", "--json", json, "--svg", svg};
  const Ending shown = bch({"inspect", baked}, at);
  ASSERT_EQ(shown.code, 0) << shown.err;
  EXPECT_NE(shown.out.find("slab 2: nothing"), std::string::npos) << shown.out;
  const auto from_file = read_json(json)["animated"], parts = from_file["parts"];
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_EQ(parts[0]["heights"], "slab 2");
  EXPECT_EQ(parts[0]["at"]["discs"].size(), 0u);
  for (const int i : {1, 2}) EXPECT_GT(parts[i]["at"]["discs"].size(), 30u);
  EXPECT_NE(parts[1]["at"]["discs"], parts[2]["at"]["discs"]);
  const std::string of_file = read_text(svg);
  EXPECT_EQ(of_file.find("class=\"outline\""), std::string::npos);
  // What the file has is what is made of the character.
  const Ending made = bch({"inspect", "default:male", "--slices", "1,2.5"}, at);
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(read_json(json)["animated"], from_file);
  const std::string drawn = read_text(svg);
  for (const char* what : {"class=\"outline\"", "0.00 to 1.00 m, 0.400 s", "slab 2, 0.400 s: nothing"})
    EXPECT_NE(drawn.find(what), std::string::npos) << what;
  EXPECT_EQ(drawn.find("nan"), std::string::npos);
  expect_failure(bch({"inspect", baked, "--animated", "--clip", "idle think", "--time", "6.1"}), 3,
                 {baked, "idle think", "6.1"});
}

TEST(Cli, ClipsThatCannotBeMovingDiscsAreNamed) {
  const TemporaryFolder folder;
  const std::string baked = folder.file("p.bch"), obj = folder.write("box.obj", box);
  expect_failure(bch({"bake", "default:male", "--animated", "wlak", "-o", baked}), 3, {"--animated", "wlak"});
  expect_failure(bch({"bake", obj, "--animated", "all", "-o", baked}, as_metres), 3, {"--animated", "all"});
  EXPECT_FALSE(std::filesystem::exists(baked));
  ASSERT_EQ(bch({"bake", "default:male", "--poses", "1", "-o", baked}).code, 0);
  expect_failure(bch({"inspect", baked, "--animated", "--clip", "walk", "--time", "0"}), 3,
                 {baked, "walk", "bch bake --animated"});
  expect_failure(bch({"inspect", baked, "--clip", "walk", "--time", "0"}), 2, {"--animated"});
  expect_failure(bch({"inspect", "default:male", "--animated"}), 2, {"--animated", "--clip"});
}

TEST(Cli, BakedFilesAreNoCharacters) {
  const TemporaryFolder folder;
  const std::string baked = folder.file("p.bch");
  ASSERT_EQ(bch({"bake", "default:male", "--poses", "1", "-o", baked}).code, 0);
  expect_failure(bch({"bake", baked, "-o", folder.file("q.bch")}), 3, {baked, "is a baked file"});
  expect_failure(bch({"report", "--out", folder.file("report"), "--character", baked}), 3,
                 {baked, "is a baked file"});
  EXPECT_FALSE(std::filesystem::exists(folder.file("report/run.csv")));
}

/// A disk that is full, as far as this program may fill it.
TEST(Cli, FilesThatDoNotFitLeaveNothing) {
  const TemporaryFolder folder;
  Streams small;
  small.largest_file = 8192;
  const std::string baked = folder.file("a.bch"), json = folder.write("a.json", "old");
  // 600: it does not fit long before all poses are built.
  for (const char* poses : {"20", "600"})
    expect_failure(bch({"bake", "default:male", "--poses", poses, "-o", baked}, {}, small), 3,
                   {baked, "too large"});
  expect_failure(bch({"crowd", "--poses", "2", "--agents", "300", "--svg", json}, {}, small), 3,
                 {json, "too large"});
  EXPECT_EQ(read_text(json), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

/// Whenever it comes: the file is whole, or not there.
TEST(Cli, InterruptsWhileBakingLeaveAllOrNothing) {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.bch");
  for (const int milliseconds : {1, 5, 20, 40, 80, 160, 320}) {
    const Ending run = bch({"bake", "default:male", "--poses", "100", "-o", file}, {},
                           {"", std::chrono::milliseconds(milliseconds)});
    if (std::filesystem::exists(file))
      EXPECT_EQ(bch({"inspect", file}).code, 0) << milliseconds;
    else
      EXPECT_TRUE(run.code == 130 || run.code == -SIGINT) << run.code << " after " << milliseconds << " ms";
    std::filesystem::remove(file);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << milliseconds;
  }
}

TEST(Cli, BakingLeavesAllOrNothing) {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.bch");
  const std::string full = folder.file("full.bch");
  std::filesystem::create_symlink("/dev/full", full);
  expect_failure(bch({"bake", "default:male", "--poses", "1", "-o", full}), 3, {full, "No space"});
  std::filesystem::remove(full);
  expect_failure(bch({"bake", "default:male", "--poses", "1", "-o", "/nowhere/a.bch"}), 3,
                 {"/nowhere/a.bch"});
  const Ending run = bch({"bake", "default:male", "--poses", "200000", "-o", file}, {},
                         {"", std::chrono::milliseconds(400)});
  EXPECT_EQ(run.code, 130);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err, "bch: interrupted\n");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace bch::test
