// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/bch_run.hpp"
#include "tests/support/temporary_folder.hpp"

// `bch check`.

namespace bch::test {
namespace {

/// Two people who walk through each other in 4 s, and a third who is never near them.
std::string two_who_meet() {
  std::string text = "# framerate: 25\n# id frame x/m y/m z/m\n";
  for (int k = 0; k < 100; ++k)
    text += fmt::format("7 {0} {1:.3f} 0 1.8\n5 {0} {2:.3f} 0.1 1.7\n12 {0} 3 {3:.3f} 1.6\n", k,
                        -2.4 + 0.048 * k, 2.4 - 0.048 * k, 5 + 0.04 * k);
  return text;
}

TEST(Cli, CheckTellsWhoRunsIntoWhom) {
  const TemporaryFolder folder;
  const std::string file = folder.write("two.txt", two_who_meet());
  const std::string events = folder.file("events.csv"), frames = folder.file("frames.csv"),
                    pairs = folder.file("pairs.csv"), json = folder.file("check.json"),
                    page = folder.file("check.html");
  const Ending run = bch({"check", file, "--events", events, "--frames", frames, "--pairs", pairs, "--json",
                          json, "--html", page, "--max-distance", "0.5"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  for (const char* const words :
       {"PeTrack text, 25 frames a second", "3 in 100 frames (4.0 s), 300 person-frames",
        "% of person-seconds", "0.40 m", "The deepest:"})
    EXPECT_NE(run.out.find(words), std::string::npos) << words << "\n" << run.out;

  const nlohmann::json summary = read_json(json);
  EXPECT_EQ(summary["people"], 3);
  EXPECT_EQ(summary["all"]["person_frames"], 300);
  EXPECT_GT(summary["all"]["overlapping"], 10);
  std::size_t overlaps = 0;
  for (const nlohmann::json& event : summary["events"]) {
    EXPECT_EQ(event["first"], 5);
    EXPECT_EQ(event["second"], 7);
    overlaps += event["kind"] == "overlap";
  }
  EXPECT_GT(overlaps, 0u);
  EXPECT_EQ(lines(read_text(events)), 1 + summary["events"].size());
  EXPECT_TRUE(read_text(events).starts_with("first,second,kind,from,to,frames,worst,depth,x,y\n5,7,"));
  EXPECT_EQ(lines(read_text(frames)), 101u);
  EXPECT_NE(read_text(frames).find("\n50,2.0000,3,"), std::string::npos);
  EXPECT_NE(read_text(pairs).find(",5,7,near,"), std::string::npos);
  EXPECT_NE(read_text(page).find("two.txt"), std::string::npos);
  EXPECT_EQ(read_text(page).find(folder.path().string()), std::string::npos);
}

/// People who walk through each other between two frames, a second apart.
TEST(Cli, CheckTellsWhenAndWherePeoplePass) {
  const TemporaryFolder folder;
  std::string rows = "id,frame,x,y\n";
  for (int k = 0; k < 4; ++k)
    rows += fmt::format("1,{0},{1},5000\n2,{0},{2},5000\n", k, 9000 - 3 + 2 * k, 9000 + 3 - 2 * k);
  const std::string file = folder.write("pass.csv", rows), events = folder.file("events.csv"),
                    pairs = folder.file("pairs.csv"), json = folder.file("check.json"),
                    page = folder.file("check.html");
  const Ending run = bch({"check", file, "--unit", "m", "--fps", "1", "--events", events, "--pairs", pairs,
                          "--json", json, "--html", page});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("1 event, 1 of them between two frames"), std::string::npos) << run.out;
  const nlohmann::json event = read_json(json)["events"].at(0);
  EXPECT_EQ(event["kind"], "pass");
  EXPECT_EQ(event["worst_frame"], 1);
  const double after = event["after"];
  EXPECT_GT(after, 0.2);
  EXPECT_LT(after, 0.5);
  EXPECT_NEAR(event["x"].get<double>(), 8999 + 2 * after, 1e-3);
  EXPECT_EQ(event["y"], 5000);
  EXPECT_NE(read_text(events).find(fmt::format("\n1,2,pass,1.0000,1.0000,1,{:.4f},0.0000,{:.3f},5000.000\n",
                                               1 + after, event["x"].get<double>())),
            std::string::npos)
      << read_text(events);
  EXPECT_EQ(read_text(pairs).find("pass,0.0000,0.0000"), std::string::npos) << read_text(pairs);
  EXPECT_NE(read_text(page).find(fmt::format("\"events\":[[1,2,1.0,1.0,{:.4f}", 1 + after)),
            std::string::npos);
}

/// As many as a small file may have, so that memory is wanted for their pairs.
TEST(Cli, CheckLimitsThePairs) {
  const TemporaryFolder folder;
  std::string rows = "id,frame,x,y\n";
  for (int i = 0; i < 20'000; ++i) rows += fmt::format("{},7,0,0\n", i);
  const std::string file = folder.write("spot.csv", rows), events = folder.file("events.csv");
  const Ending run = bch({"check", file, "--unit", "m", "--fps", "1", "--events", events});
  EXPECT_EQ(run.code, 3);
  EXPECT_EQ(run.err, fmt::format("bch: {}: frame 7: more than 6000000 pairs of people are near each other; "
                                 "--max-pairs raises the limit\n",
                                 file));
  EXPECT_EQ(run.out, "");
  EXPECT_FALSE(std::filesystem::exists(events));
  const std::string two = folder.write("two.txt", two_who_meet());
  EXPECT_EQ(bch({"check", two, "--max-pairs", "5"}).code, 3);
  EXPECT_EQ(bch({"check", two, "--max-pairs", "1000"}).code, 0);
}

TEST(Cli, CheckWritesTheSameForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  const std::string file = folder.write("two.txt", two_who_meet());
  std::vector<std::string> written;
  for (const char* const threads : {"1", "2"}) {
    const std::string pairs = folder.file("pairs.csv"), page = folder.file("check.html");
    const Ending run =
        bch({"check", file, "--pairs", pairs, "--html", page, "--slices", "0.4,1", "--threads", threads});
    EXPECT_EQ(run.code, 0) << run.err;
    written.push_back(run.out + read_text(pairs) + read_text(page));
  }
  EXPECT_TRUE(written[0] == written[1]);
}

TEST(Cli, CheckAsksAtADepth) {
  const TemporaryFolder folder;
  const std::string file = folder.write("two.txt", two_who_meet());
  std::vector<std::uint64_t> overlapping;
  for (const char* const depth : {"0", "4", "all"}) {
    const std::string json = folder.file("check.json"), page = folder.file("check.html");
    const Ending run =
        bch({"check", file, "--depth", depth, "--leaves", "discs", "--json", json, "--html", page});
    EXPECT_EQ(run.code, 0) << run.err;
    const std::string discs = depth == std::string("all") ? "their leaves" : fmt::format("depth {}", depth);
    EXPECT_NE(run.out.find("whole, discs of " + discs + ", "), std::string::npos) << run.out;
    EXPECT_NE(read_text(page).find("whole, discs of " + discs), std::string::npos);
    EXPECT_EQ(read_json(json)["depth"], depth);
    overlapping.push_back(read_json(json)["all"]["overlapping"]);
  }
  EXPECT_GT(overlapping[0], overlapping[1]);
  EXPECT_GE(overlapping[1], overlapping[2]);
  EXPECT_EQ(bch({"check", file, "--depth", "deep"}).code, 2);
  EXPECT_EQ(bch({"check", file, "--leaves", "twigs"}).code, 2);
}

TEST(Cli, CheckTakesCharactersOfOnesOwn) {
  const TemporaryFolder folder;
  const std::string file = folder.write("two.txt", two_who_meet());
  std::vector<std::string> written;
  for (const char* const threads : {"1", "2"}) {
    const std::string json = folder.file("check.json");
    const Ending run = bch({"check", "--character", "default:bulky", "--character", "default:female", file,
                            "--json", json, "--threads", threads});
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_NE(run.out.find("2 characters, whole, their outlines"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("default:bulky: walks, by its feet, at "), std::string::npos) << run.out;
    EXPECT_GT(read_json(json)["all"]["overlapping"], 10);
    written.push_back(run.out + read_text(json));
  }
  EXPECT_TRUE(written[0] == written[1]);
  const std::string stick = folder.write("stick.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(bch({"check", file, "--clips", stick}).code, 2);  // of whom?
  const Ending run = bch({"check", file, "--character", stick});
  EXPECT_EQ(run.code, 3);
  EXPECT_NE(run.err.find("stick.obj: none of its clips walks straight on"), std::string::npos) << run.err;
}

TEST(Cli, CheckTakesABakedSet) {
  const TemporaryFolder folder;
  const std::string file = folder.write("two.txt", two_who_meet()), people = folder.file("people.bch");
  ASSERT_EQ(
      bch({"bake", "default:male", "default:female", "--poses", "200", "--depths", "0,all", "-o", people})
          .code,
      0);
  std::vector<std::string> written;
  for (const char* const threads : {"1", "2"}) {
    const std::string json = folder.file("check.json"), page = folder.file("check.html");
    const Ending run = bch({"check", file, "--character", people, "--clip-speed", "walk=1.3", "--json", json,
                            "--html", page, "--threads", threads});
    EXPECT_EQ(run.code, 0) << run.err;
    for (const char* const words : {"2 characters, whole, their outlines", "those of the baked set",
                                    "people face 0 degrees", "default:male: walks in walk at 1.3 m/s"})
      EXPECT_NE(run.out.find(words), std::string::npos) << words << "\n" << run.out;
    EXPECT_GT(read_json(json)["all"]["overlapping"], 10);
    written.push_back(run.out + read_text(json) + read_text(page));
  }
  EXPECT_TRUE(written[0] == written[1]);
  const auto refused = [&](int code, std::vector<std::string> more, const char* words) {
    more.insert(more.begin(), {"check", file});
    expect_failure(bch(more), code, {words});
  };
  refused(3, {"--character", people}, "--clip-speed");
  refused(3, {"--character", people, "--clip-speed", "hop=1"}, "has no clip called hop");
  refused(2, {"--character", people, "--clip-speed", "walk"}, "'walk'");
  refused(2, {"--character", people, "--depth", "3"}, "baked already");
  refused(2, {"--character", people, "--character", "default:male"}, "a baked set has all characters");
  refused(2, {"--character", "default:male", "--facing", "90"}, "baked set");
}

TEST(Cli, CheckPlaysWhatRowsName) {
  const TemporaryFolder folder;
  std::string rows = "frame,id,x,y,character,clip,time\n";
  for (int k = 0; k < 25; ++k)
    rows += fmt::format("{0},1,0,{1:.2f},default:male,walk,{2:.2f}\n{0},2,1,{1:.2f},default:female,,\n", k,
                        0.04 * k, 0.01 * k);
  const std::string file = folder.write("named.csv", rows);
  const std::vector<std::string> check{"check",       file,           "--fps",       "25",
                                       "--character", "default:male", "--character", "default:female"};
  const Ending run = bch(check);
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("Times are those of the clips that rows name"), std::string::npos) << run.out;
  expect_failure(bch({"check", file, "--fps", "25"}), 3, {"named.csv:2", "'default:male'", "--character"});
  expect_failure(bch({"check", file, "--fps", "25", "--character", "default:male"}), 3,
                 {"named.csv:3", "'default:female'"});
}

TEST(Cli, CheckFailsWhereItsUserWantsItTo) {
  const TemporaryFolder folder;
  const std::string file = folder.write("two.txt", two_who_meet());
  EXPECT_EQ(bch({"check", file, "--fail-above", "50"}).code, 0);
  const Ending run = bch({"check", file, "--fail-above", "1"});
  EXPECT_EQ(run.code, 1);
  EXPECT_NE(run.out.find("overlaps"), std::string::npos);
  EXPECT_NE(run.err.find("more than 1 %"), std::string::npos) << run.err;
}

TEST(Cli, CheckMeetsWalls) {
  const TemporaryFolder folder;
  const std::string file = folder.write("two.txt", two_who_meet());
  const std::string floor = folder.write("floor.wkt", "POLYGON((-9 -9, 2.8 -9, 2.8 20, -9 20))");
  const Ending run = bch({"check", file, "--walls", floor});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("wall 0"), std::string::npos) << run.out;
}

/// Devices that never end are refused at their first bytes: without that, the test runs out of memory.
TEST(Cli, WallsOfADeviceAreRefused) {
  const TemporaryFolder folder;
  const std::string file = folder.write("two.txt", two_who_meet());
  expect_failure(bch({"check", file, "--walls", "/dev/zero"}), 3, {"/dev/zero", "line 1, column 1"});
  expect_failure(bch({"place", "--obstacles", "/dev/zero"}), 3, {"/dev/zero", "line 1, column 1"});
  expect_failure(bch({"check", "/dev/zero"}), 3, {"/dev/zero"});
  expect_failure(bch({"check", file, "--character", "/dev/zero"}), 3, {"/dev/zero"});
  expect_failure(bch({"merge", "/dev/zero"}), 3, {"/dev/zero"});
}

TEST(Cli, CheckRefusesWhatItCannotRead) {
  const TemporaryFolder folder;
  const std::string unknown = folder.write("no.txt", "1 0 10 20 180\n1 1 11 21 180\n");
  expect_failure(bch({"check", unknown}), 3, {"no.txt", "--unit", "--fps"});
  EXPECT_EQ(bch({"check", unknown, "--unit", "cm", "--fps", "16"}).code, 0);
  expect_failure(bch({"check", unknown, "--unit", "parsec", "--fps", "16"}), 2, {"--unit", "parsec"});
  const std::string eth =
      folder.write("obsmat.txt", "780 1 8.5 0 3.5 1.6 0 0.05\n786 1 8.75 0 3.6 1.6 0 0.05\n");
  expect_failure(bch({"check", eth, "--unit", "m", "--fps", "15"}), 3,
                 {"obsmat.txt:1", "--columns", "'780 1 8.5 0 3.5 1.6 0 0.05'"});
  EXPECT_NE(bch({"check", eth, "--unit", "m", "--fps", "15", "--columns", "frame,id,x,skip,y"})
                .out.find("1 in 2 frames"),
            std::string::npos);
  expect_failure(bch({"check", folder.file("absent.txt")}), 3, {"absent.txt"});
  const std::string page = folder.file("check.html");
  const std::string twice =
      folder.write("twice.txt", "# framerate: 25\n# id frame x/m y/m\n1 0 1 1\n1 0 2 2\n");
  expect_failure(bch({"check", twice, "--html", page}), 3, {"twice.txt", "1"});
  EXPECT_FALSE(std::filesystem::exists(page));
  expect_failure(bch({"check", twice, "--events", twice}), 2, {"--events"});
  const std::string jumps = folder.write("jumps.csv", "frame,id,x,y\n0,1,0,0\n1,1,0.1,0\n2,1,100.1,0\n");
  expect_failure(bch({"check", jumps, "--fps", "25", "--html", page}), 3,
                 {"jumps.csv:4", "person 1 jumps by 100 m", "frame 2"});
  EXPECT_FALSE(std::filesystem::exists(page));
}

}  // namespace
}  // namespace bch::test
