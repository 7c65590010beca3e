// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <signal.h>

#include <nlohmann/json.hpp>

#include "layout/format/shape_set_view.hpp"
#include "tests/support/baked_bytes.hpp"
#include "tests/support/bch_run.hpp"
#include "tests/support/outline_soups.hpp"
#include "tests/support/test.hpp"

// `bch bake`, and the other commands on the files that it writes.

namespace bch::test {
namespace {

TEST(Cli, BakedShapesAnswerLikeTheirCharacter) {
  const TemporaryFolder folder;
  const std::string baked = folder.file("female.bch"),
                    agents = folder.write("agents.csv", crooked_lattice(9, 5, 3));
  const Arguments how{"--poses", "5", "--depths", "0,4,all"};
  const Ending bake = bch({"bake", "default:female", "-o", baked}, how);
  ASSERT_EQ(bake.code, 0) << bake.err;
  EXPECT_EQ(bake.err, "");
  EXPECT_NE(bake.out.find("0, 4, all"), std::string::npos) << bake.out;
  const Ending expected = bch({"query", "default:female", agents, "--all-pairs"}, how);
  const Ending run = bch({"query", baked, agents, "--all-pairs"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.out, expected.out);
  EXPECT_GT(lines(expected.out), 20u);
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
}

TEST(Cli, BadBakedFilesGiveThreeAndOneLine) {
  const TemporaryFolder folder;
  const std::string baked = folder.file("male.bch");
  ASSERT_EQ(bch({"bake", "default:male", "--poses", "1", "-o", baked}).code, 0);
  const std::string text = read_text(baked);
  std::string flipped = text;
  flipped[text.size() / 2] ^= 4;
  std::string newer = text;
  const std::string newer_version = "version " + std::to_string(++newer[12]);
  const std::pair<std::string, const char*> cases[] = {{"", "too few"},
                                                       {text.substr(0, 3000), "3000"},
                                                       {flipped, "wrong checksum"},
                                                       {newer, newer_version.c_str()},
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

/// What a file has of a clip is what is made of the character, drawn without the outlines that only this has; the poses
/// are those of a file without clips.
TEST(Cli, BakedFilesKeepClipsAsMovingDiscs) {
  const TemporaryFolder folder;
  const std::string baked = folder.file("p.bch"), plain = folder.file("q.bch"), json = folder.file("p.json"),
                    svg = folder.file("p.svg"), agents = folder.write("agents.csv", crooked_lattice(5, 3, 1));
  const Arguments bake{"bake", "default:male", "--poses", "3"};
  ASSERT_EQ(bch(bake, {"-o", plain}).code, 0);
  ASSERT_EQ(bch(bake, {"-o", baked, "--animated", "idle think"}).code, 0);
  EXPECT_EQ(bch({"query", baked, agents, "--all-pairs"}).out,
            bch({"query", plain, agents, "--all-pairs"}).out);
  const Arguments at{"--animated", "--clip", "idle think", "--time", "0.4", "--json", json, "--svg", svg};
  ASSERT_EQ(bch({"inspect", baked}, at).code, 0);
  const auto of_file = read_json(json)["animated"];
  EXPECT_EQ(read_text(svg).find("class=\"outline\""), std::string::npos);
  ASSERT_EQ(bch({"inspect", "default:male"}, at).code, 0);
  EXPECT_EQ(read_json(json)["animated"], of_file);
  const std::string drawn = read_text(svg);
  EXPECT_NE(drawn.find("<circle"), std::string::npos);
  EXPECT_NE(drawn.find("class=\"outline\""), std::string::npos);
  EXPECT_EQ(drawn.find("nan"), std::string::npos);
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
  EXPECT_EQ(folder.files(), 1);
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
  const std::string full = folder.file("full.bch");
  std::filesystem::create_symlink("/dev/full", full);
  expect_failure(bch({"bake", "default:male", "--poses", "1", "-o", full}), 3, {full, "No space"});
  std::filesystem::remove(full);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

// ---- What a character file may cost once it is read. The large meshes would take minutes to hours if what is done with them
// were not linear or nearly so, beyond this test's time limit.

const Arguments seen_from_above{"--up", "z", "--scale", "1"};

template <class Value>
void append_bytes(std::string& bytes, const Value& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// The triangles as a binary STL file, where each has vertices of its own.
std::string stl_file(const Soup& soup) {
  std::string bytes(80, '\0');
  append_bytes(bytes, static_cast<std::uint32_t>(soup.triangles.size()));
  for (const auto& triangle : soup.triangles) {
    append_bytes(bytes, Vec3());  // no normal
    for (const std::uint32_t vertex : triangle) append_bytes(bytes, soup.positions[vertex]);
    append_bytes(bytes, std::uint16_t{0});
  }
  return bytes;
}

std::string soup_file(const TemporaryFolder& folder, std::uint32_t triangles) {
  return folder.write("soup.stl", stl_file(separate_triangles(triangles)));
}

TEST(CliLimits, AMeshOfManyIslandsIsInspected) {
  const TemporaryFolder folder;
  const Ending run = bch({"inspect", soup_file(folder, 360'000)}, seen_from_above);
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("rest pose"), std::string::npos) << run.out;
}

TEST(CliLimits, AShapeOfManyNodesIsWritten) {
  const TemporaryFolder folder;
  const std::string json = folder.file("soup.json"), svg = folder.file("soup.svg");
  const Ending run = bch({"inspect", soup_file(folder, 100'000), "--shape", "0", "--threshold", "1e-3",
                          "--json", json, "--svg", svg, "--max-drawn-nodes", "1000000"},
                         seen_from_above);
  ASSERT_EQ(run.code, 0) << run.err;
  const auto shape = read_json(json)["shape"];
  EXPECT_EQ(shape["outline"]["contours"].size(), 100'000u);
  EXPECT_GT(shape["nodes"], 300'000);
  EXPECT_GT(std::filesystem::file_size(svg), 1'000'000u);
}

TEST(CliLimits, TimeAndMemoryAreLimitedAndNoFileIsLeft) {
  const TemporaryFolder folder;
  const std::string soup = soup_file(folder, 200'000);
  const auto bake = [&](const Arguments& more) {
    Arguments arguments{"bake", soup, "--depths", "all", "--threshold", "1e-3", "-o", folder.file("a.bch")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return bch(arguments, seen_from_above);
  };
  expect_failure(bake({"--max-seconds", "0.01"}), 3,
                 {"soup.stl: ", "more than 0.01 s", "--max-seconds raises the limit"});
#ifndef BCH_SANITIZED  // whose memory is not counted
  expect_failure(bake({"--max-memory", "0.01"}), 3,
                 {"soup.stl: ", "more than 0.01 GiB", "--max-memory raises the limit"});
#endif
  EXPECT_EQ(folder.files(), 1);
}

}  // namespace
}  // namespace bch::test
