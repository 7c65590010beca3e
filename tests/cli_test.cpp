// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "kernel/implementation.hpp"
#include "program_run.hpp"
#include "tests/character_shapes.hpp"
#include "tests/temporary_folder.hpp"

namespace bch::test {
namespace {

using Arguments = std::vector<std::string>;

/// A person-sized box, 0.5 m x 0.3 m on the ground, y up.
constexpr const char* box =
    "v -0.25 0 -0.15\nv 0.25 0 -0.15\nv 0.25 0 0.15\nv -0.25 0 0.15\n"
    "v -0.25 1.8 -0.15\nv 0.25 1.8 -0.15\nv 0.25 1.8 0.15\nv -0.25 1.8 0.15\n"
    "f 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";
const Arguments as_metres{"--up", "y", "--scale", "1"};
constexpr const char* four_agents =
    "id,shape,x,y,heading\na,0,0,0,0\nb,0,0.4,0,0\nc,0,0,0.35,0\n\"d,e\",0,9,9,1\n";

Ending bch(Arguments arguments, const Arguments& more = {}, const Streams& streams = {}) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_program(BCH_PROGRAM, arguments, streams);
}

std::size_t lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// One line on standard error that has all of the words, and nothing on standard output.
void expect_failure(const Ending& run, int code, const Arguments& words) {
  EXPECT_EQ(run.code, code) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(lines(run.err), 1u) << run.err;
  EXPECT_TRUE(run.err.starts_with("bch: ")) << run.err;
  for (const std::string& word : words)
    EXPECT_NE(run.err.find(word), std::string::npos) << "no '" << word << "' in: " << run.err;
}

TEST(Cli, HelpAndVersionGoToStandardOutput) {
  for (const Arguments& arguments : {Arguments{"--help"},
                                     {"--version"},
                                     {"bake", "--help"},
                                     {"crowd", "--help"},
                                     {"inspect", "--help"},
                                     {"query", "--help"}}) {
    const Ending run = bch(arguments);
    EXPECT_EQ(run.code, 0);
    EXPECT_EQ(run.err, "");
    EXPECT_NE(run.out, "");
    EXPECT_EQ(run.out.back(), '\n');
  }
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
      {{"crowd", "--svg-depth", "5"}, "--svg-depth"},
      {{"crowd", "--character", "default:dog"}, "default:dog"},
      {{"crowd", "--clips", "walk.bvh"}, "--clips"},
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
  };
  for (const auto& [arguments, word] : cases) expect_failure(bch(arguments), 2, {word});
}

TEST(Cli, OutputThatCannotBeWrittenIsReported) {
  expect_failure(bch({"--version"}, {}, {"/dev/full", {}}), 3, {"standard output"});
  expect_failure(bch({"crowd", "--json", "/nowhere/crowd.json"}), 3, {"/nowhere/crowd.json"});
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
  const auto json = nlohmann::json::parse(read_text(json_file));
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
  const auto json = nlohmann::json::parse(read_text(json_file));
  ASSERT_EQ(json["shapes"].size(), 4u);
  EXPECT_EQ(json["shapes"][3]["shape"], 3);
  EXPECT_EQ(json["character"]["clip_seconds"], 212);
}

TEST(Cli, QueryAnswersInTheOrderOfThePairs) {
  const TemporaryFolder folder;
  const std::string shapes = folder.write("box.obj", box), agents = folder.write("agents.csv", four_agents);
  const std::string pairs =
      folder.write("pairs.csv", "second,first\r\na,b\r\n\r\nc,a\r\n \"d,e\" ,a\r\na,a\r\n");
  const Ending run = bch({"query", shapes, agents, pairs}, as_metres);
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.out, "first,second,hit\nb,a,1\na,c,0\na,\"d,e\",0\na,a,1\n");
  EXPECT_EQ(run.err, "");
}

TEST(Cli, QueryTakesALevelForEachAgent) {
  const TemporaryFolder folder;
  const std::string shapes = folder.write("box.obj", box);
  const std::string pairs = folder.write("pairs.csv", "first,second\na,b\na,c\n");
  const std::string agents =
      folder.write("agents.csv", "id,shape,x,y,heading,level\na,0,0,0,0,0\nb,0,0,0.35,0,0\nc,0,0,0.35,0,1\n");
  const Ending run = bch({"query", shapes, agents, pairs, "--depths", "0,all"}, as_metres);
  EXPECT_EQ(run.out, "first,second,hit\na,b,1\na,c,1\n") << run.err;
  const std::string finest =
      folder.write("agents.csv", "id,shape,x,y,heading,level\na,0,0,0,0,1\nb,0,0,0.35,0,1\nc,0,0,0.35,0,1\n");
  EXPECT_EQ(bch({"query", shapes, finest, pairs, "--depths", "0,all"}, as_metres).out,
            "first,second,hit\na,b,0\na,c,0\n");
}

/// Agents on a crooked lattice, dense enough for many to collide.
std::string lattice(int side) {
  std::ostringstream csv;
  csv << "id,shape,x,y,heading\n";
  for (int i = 0; i < side * side; ++i)
    csv << "agent" << i << ",0," << 0.43 * (i % side) + 0.01 * (i % 7) << ',' << 0.41 * (i / side) << ','
        << 0.7 * i << '\n';
  return csv.str();
}

TEST(Cli, AllPairsEqualsExplicitPairs) {
  const TemporaryFolder folder;
  constexpr int side = 9;
  const std::string shapes = folder.write("box.obj", box), agents = folder.write("agents.csv", lattice(side));
  std::string every = "first,second\n";
  for (int a = 0; a < side * side; ++a)
    for (int b = a + 1; b < side * side; ++b)
      every += "agent" + std::to_string(a) + ",agent" + std::to_string(b) + "\n";
  const Ending each = bch({"query", shapes, agents, folder.write("pairs.csv", every)}, as_metres);
  const Ending all = bch({"query", shapes, agents, "--all-pairs"}, as_metres);
  ASSERT_EQ(each.code, 0) << each.err;
  ASSERT_EQ(all.code, 0) << all.err;
  std::string expected;
  std::istringstream rows(each.out);
  for (std::string row; std::getline(rows, row);)
    if (!row.ends_with(",0")) expected += row + "\n";
  EXPECT_EQ(all.out, expected);
  EXPECT_GT(lines(all.out), 20u);
}

TEST(Cli, BadAgentsNameFileLineAndValue) {
  const TemporaryFolder folder;
  const std::string shapes = folder.write("box.obj", box);
  const std::string pairs = folder.write("pairs.csv", "first,second\n");
  const std::string header = "id,shape,x,y,heading\na,0,0,0,0\n";
  const std::pair<std::string, std::string> cases[] = {
      {"", "agents.csv: is empty"},
      {"id,shape,x,y\na,0,0,0\n", "agents.csv:1: has no column 'heading'"},
      {"id,shape,x,y,heading,speed\n", "agents.csv:1: column 'speed'"},
      {"id,shape,x,x,y,heading\n", "agents.csv:1: column 'x' is there twice"},
      {header + "b,0,1.0abc,0,0\n", "agents.csv:3: x '1.0abc'"},
      {header + "b,0,,0,0\n", "agents.csv:3: x ''"},
      {header + "b,0,nan,0,0\n", "agents.csv:3: x 'nan'"},
      {header + "b,0,0,-inf,0\n", "agents.csv:3: y '-inf'"},
      {header + "b,0,0,0,1e10\n", "agents.csv:3: heading '1e10'"},
      {header + "b,0,2e9,0,0\n", "agents.csv:3: x '2e9'"},
      {header + "b,0,1e999,0,0\n", "agents.csv:3: x '1e999'"},
      {header + "\nb,1,0,0,0\n", "agents.csv:4: shape '1'"},
      {header + "b,-1,0,0,0\n", "agents.csv:3: shape '-1'"},
      {header + "b,0.5,0,0,0\n", "agents.csv:3: shape '0.5'"},
      {header + "a,0,0,0,0\n", "agents.csv:3: id 'a' is there twice"},
      {header + ",0,0,0,0\n", "agents.csv:3: id ''"},
      {header + "b,0,0,0\n", "agents.csv:3: has fewer values"},
      {header + "b,0,0,0,0,0\n", "agents.csv:3: has more values"},
      {header + "\"b,0,0,0,0\n", "agents.csv:3: a quote is not closed"},
      {"id,shape,x,y,heading,level\na,0,0,0,0,4\n", "agents.csv:2: level '4'"},
      {"id,shape,x,y,heading,level\na,0,0,0,0,\n", "agents.csv:2: level ''"},
  };
  for (const auto& [text, words] : cases)
    expect_failure(bch({"query", shapes, folder.write("agents.csv", text), pairs}, as_metres), 3, {words});
  expect_failure(bch({"query", shapes, folder.file("none.csv"), pairs}, as_metres), 3, {"none.csv: "});
  expect_failure(bch({"query", shapes, folder.path().string(), pairs}, as_metres), 3,
                 {folder.path().string()});
}

TEST(Cli, BadPairsNameFileLineAndValue) {
  const TemporaryFolder folder;
  const std::string shapes = folder.write("box.obj", box), agents = folder.write("agents.csv", four_agents);
  const std::pair<std::string, std::string> cases[] = {
      {"first\na\n", "pairs.csv:1: has no column 'second'"},
      {"first,second\na,nobody\n", "pairs.csv:2: second 'nobody'"},
      {"first,second\na,b\n,a\n", "pairs.csv:3: first ''"},
      {"first,second\na\n", "pairs.csv:2: has fewer"},
      {"a,b\na,b\n", "pairs.csv:1: "},
  };
  for (const auto& [text, words] : cases)
    expect_failure(bch({"query", shapes, agents, folder.write("pairs.csv", text)}, as_metres), 3, {words});
}

/// What must not depend on the machine: the answers.
struct CrowdAnswer {
  std::vector<std::uint64_t> hits;
  std::string csv;
  friend bool operator==(const CrowdAnswer&, const CrowdAnswer&) = default;
};

CrowdAnswer small_crowd(const TemporaryFolder& folder, const Arguments& more) {
  const std::string json_file = folder.file("crowd.json"), csv_file = folder.file("crowd.csv");
  const Ending run =
      bch({"crowd", "--agents", "200", "--poses", "5", "--json", json_file, "--csv", csv_file}, more);
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  CrowdAnswer answer{{}, read_text(csv_file)};
  const auto json = nlohmann::json::parse(read_text(json_file));
  for (const auto& level : json["levels"]) answer.hits.push_back(level["hits"]);
  return answer;
}

TEST(Cli, CrowdGivesTheSameAnswersEverywhere) {
  const TemporaryFolder folder;
  const CrowdAnswer first = small_crowd(folder, {"--threads", "1"});
  ASSERT_EQ(first.hits.size(), 4u);
  EXPECT_GT(first.hits[0], first.hits[3]);
  EXPECT_EQ(lines(first.csv), first.hits[3] + 1);
  EXPECT_EQ(first, small_crowd(folder, {"--threads", "3"}));
  EXPECT_NE(first, small_crowd(folder, {"--seed", "2"}));
  for (const kernel::Implementation& row : kernel::implementations())
    if (row.supported()) {
      EXPECT_EQ(first, small_crowd(folder, {"--isa", row.name})) << row.name;
    }
  EXPECT_GE(small_crowd(folder, {"--semantics", "solid"}).hits[3], first.hits[3]);
}

TEST(Cli, CrowdDrawsAPicture) {
  const TemporaryFolder folder;
  const std::string svg_file = folder.file("crowd.svg");
  const Ending run = bch({"crowd", "--agents", "200", "--poses", "5", "--svg", svg_file});
  ASSERT_EQ(run.code, 0) << run.err;
  const std::string svg = read_text(svg_file);
  EXPECT_TRUE(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
  EXPECT_LT(svg.size(), 600000u);
  for (const char* id :
       {"crowd", "colliding", "cleared", "free", "overlaps", "single-cylinders", "legend", "scale"})
    EXPECT_NE(svg.find("id=\"" + std::string(id) + "\""), std::string::npos) << id;
  const auto count = [&svg](const std::string& word) {
    std::size_t found = 0;
    for (std::size_t at = svg.find(word); at != std::string::npos; at = svg.find(word, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count("<g"), count("</g>"));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

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

TEST(Cli, BakedCrowdIsTheCrowdOfItsCharacters) {
  const TemporaryFolder folder;
  const std::string baked = folder.file("two.bch"), json_file = folder.file("crowd.json");
  ASSERT_EQ(bch({"bake", "default:male", "default:female", "--poses", "5", "-o", baked}).code, 0);
  const auto report = [&](const Arguments& source) {
    const Ending run = bch({"crowd", "--agents", "200", "--json", json_file}, source);
    EXPECT_EQ(run.code, 0) << run.err;
    auto levels = nlohmann::json::parse(read_text(json_file))["levels"];
    for (auto& level : levels) level.erase("nanoseconds_per_pair"), level.erase("runs");
    return levels;
  };
  EXPECT_EQ(report({"--character", baked}), report({"--poses", "5"}));
  expect_failure(bch({"crowd", "--character", baked, "--semantics", "solid"}), 3, {"two.bch: ", "solid"});
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
  const auto json = nlohmann::json::parse(read_text(json_file));
  EXPECT_EQ(json["depths"], nlohmann::json({"3"}));
  EXPECT_EQ(json["threshold_m"], 0.02);
  EXPECT_EQ(json["solid"], false);
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
  newer[12] = 2;
  const std::pair<std::string, const char*> cases[] = {{"", "too few"},
                                                       {text.substr(0, 3000), "3000"},
                                                       {flipped, "wrong checksum"},
                                                       {newer, "version 2"},
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

TEST(Cli, BakingLeavesAllOrNothing) {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.bch");
  expect_failure(bch({"bake", "default:male", "--poses", "1", "-o", "/dev/full"}), 3, {"/dev/full"});
  expect_failure(bch({"bake", "default:male", "--poses", "1", "-o", "/nowhere/a.bch"}), 3,
                 {"/nowhere/a.bch"});
  const Ending run = bch({"bake", "default:male", "--poses", "200000", "-o", file}, {},
                         {"", std::chrono::milliseconds(400)});
  EXPECT_EQ(run.code, 130);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err, "bch: interrupted\n");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
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
