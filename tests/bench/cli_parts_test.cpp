// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "layout/baked/checksum.hpp"
#include "tests/support/bch_run.hpp"
#include "tests/support/test.hpp"

// `bch check --part`, `bch query --part` and `bch merge`.

namespace bch::test {
namespace {

namespace fs = std::filesystem;

/// People who walk through each other; two stand in each other all the time.
std::string crossing_people(int frames = 60) {
  std::string text = "# framerate: 10\n# id frame x/m y/m z/m\n";
  for (int k = 0; k < frames; ++k) {
    text += fmt::format("90 {0} 9 0 1.7\n91 {0} 9.1 0 1.8\n", k);
    for (int i = 0; i < 5; ++i)
      text += fmt::format("{1} {0} {2:.3f} {3} 1.8\n{4} {0} {5:.3f} {6} 1.7\n", k, 10 + i, -3.6 + 0.12 * k,
                          0.9 * i, 20 + i, 3.6 - 0.12 * k - 0.3 * i, 0.9 * i + 0.1);
  }
  return text;
}

/// All that a run writes; the outputs of one run, or of a merge.
std::string told(const TemporaryFolder& folder, Arguments arguments) {
  const Arguments kinds{"events", "frames", "pairs", "json"};
  for (const std::string& kind : kinds) {
    arguments.push_back("--" + kind);
    arguments.push_back(folder.file(kind));
  }
  const Ending run = bch(arguments);
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  std::string all = run.out;
  for (const std::string& kind : kinds) all += read_text(folder.file(kind)), fs::remove(folder.file(kind));
  return all;
}

Ending do_part(const Arguments& command, int number, int count, const fs::path& into,
               const Streams& streams = {}) {
  return bch(command, {"--part", fmt::format("{}/{}", number, count), "--into", into}, streams);
}

void do_parts(const Arguments& command, int count, const fs::path& into) {
  for (int k = 1; k <= count; ++k) {
    const Ending run = do_part(command, k, count, into);
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_TRUE(run.out.starts_with(fmt::format("part {} of {}: ", k, count))) << run.out;
  }
}

void expect_parts_make_the_run(const Arguments& command, const std::vector<int>& counts) {
  const TemporaryFolder folder;
  const std::string expected = told(folder, command);
  EXPECT_GT(expected.size(), 2'000u);
  for (const int count : counts) {
    const fs::path parts = folder.file(fmt::format("{}", count));
    do_parts(command, count, parts);
    EXPECT_TRUE(told(folder, {"merge", parts}) == expected) << command[1] << " in " << count;
  }
}

/// Parts of a check of crossing people.
class CliParts : public testing::Test {
 protected:
  Ending part(int number, int count, const Streams& streams = {}) const {
    return do_part({"check", file}, number, count, parts, streams);
  }
  /// The first part is done already, and the last one is done now: they make what one run does.
  void expect_whole_after(int last) const {
    EXPECT_NE(part(1, last).out.find("done already"), std::string::npos);
    EXPECT_EQ(part(last, last).code, 0);
    EXPECT_EQ(told(folder, {"merge", parts}), told(folder, {"check", file}));
  }

  const TemporaryFolder folder;
  const std::string file = folder.write("people.txt", crossing_people());
  const fs::path parts = folder.file("parts");
};

TEST_F(CliParts, MakeTheBytesOfOneRun) {
  const std::string floor = folder.write("floor.wkt", "POLYGON((-9 -9, 9.2 -9, 9.2 20, -9 20))");
  expect_parts_make_the_run({"check", file, "--walls", floor, "--max-distance", "0.3"}, {1, 2, 3, 7});
  const std::string few = folder.write("few.txt", crossing_people(9));
  expect_parts_make_the_run({"check", few, "--depth", "4", "--leaves", "discs"}, {11});
  expect_parts_make_the_run({"check", few, "--bodies", "spheres", "--spheres", "64"}, {3});
}

TEST_F(CliParts, OfRealRecordingsToo) {
  const char* const data = std::getenv("BCH_TEST_DATA");
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set: no real files to read";
  const fs::path recordings = fs::path(data) / "trajectories";
  expect_parts_make_the_run({"check", recordings / "single_file_n56_cam1.csv", "--fps", "25", "--columns",
                             "id,frame,x,y,skip,skip"},  // or a note would name the last two
                            {3});
#ifndef BCH_SANITIZED
  expect_parts_make_the_run({"check", recordings / "juelich_bottleneck_040_c_56_h.txt"}, {1, 2, 3, 7});
#endif
}

TEST_F(CliParts, OfQueriesMakeTheBytesOfOneRun) {
  const std::string shapes = folder.write("box.obj", box),
                    floor = folder.write("floor.wkt", "POLYGON((-9 -9, 1 -9, 1 20, -9 20))");
  std::string agents = "id,shape,x,y,heading\n", pairs = "first,second\n";
  for (int i = 0; i < 40; ++i) agents += fmt::format("\"a,{0}\",0,{1:.2f},0,{0}\n", i, 0.2 * (i % 7));
  for (int i = 0; i < 100; ++i) pairs += fmt::format("\"a,{}\",\"a,{}\"\n", i % 40, (i * 7 + 1) % 40);
  const std::string agents_file = folder.write("agents.csv", agents),
                    pairs_file = folder.write("pairs.csv", pairs);
  for (Arguments command : {Arguments{"query", shapes, agents_file, pairs_file, "--what", "contacts"},
                            Arguments{"query", shapes, agents_file, "--obstacles", floor}}) {
    command.insert(command.end(), as_metres.begin(), as_metres.end());
    const std::string expected = bch(command).out;
    EXPECT_GT(lines(expected), 40u);
    for (const int count : {2, 7}) {
      const fs::path into = folder.file(fmt::format("{}-{}", command[3].size(), count));
      do_parts(command, count, into);
      const Ending merged = bch({"merge", into});
      EXPECT_EQ(merged.out, expected) << count;
      EXPECT_EQ(do_part(command, 1, count, into).out.find("part 1 of"), 0u);
    }
  }
}

TEST_F(CliParts, AreNotDoneAgainUnlessTheyAreOfAnotherRun) {
  const fs::path manifest = parts / "part-2-of-3.manifest.json";
  do_parts({"check", file}, 3, parts);
  const auto written = fs::last_write_time(manifest);
  const Ending again = part(2, 3);
  EXPECT_EQ(again.code, 0);
  EXPECT_EQ(again.out, "part 2 of 3 is done already: " + manifest.string() + "\n");
  EXPECT_EQ(fs::last_write_time(manifest), written);
  EXPECT_EQ(do_part({"check", file, "--threads", "1"}, 2, 3, parts).out, again.out);

  fs::resize_file(parts / "part-2-of-3.pairs.csv", 5);
  expect_failure(bch({"merge", parts}), 3, {"part-2-of-3.pairs.csv", "part 2 of 3"});
  EXPECT_NE(part(2, 3).out, again.out);
  EXPECT_EQ(bch({"merge", parts}).code, 0);
  EXPECT_NE(do_part({"check", file, "--max-distance", "0.1"}, 2, 3, parts).out, again.out);
  expect_failure(bch({"merge", parts}), 3, {"part-2-of-3.manifest.json", "another run", "0.1"});
}

TEST_F(CliParts, ThatDoNotMakeARunAreNamed) {
  const fs::path second = parts / "part-2-of-3.manifest.json", json = folder.file("check.json");
  do_parts({"check", file}, 3, parts);
  const std::string manifest = read_text(second);
  const auto expect = [&](const Arguments& words) {
    expect_failure(bch({"merge", parts, "--json", json}), 3, words);
    EXPECT_FALSE(fs::exists(json));
  };
  std::string elsewhere = manifest;
  elsewhere.replace(elsewhere.find("\"part-2-of-3.frames.csv"), 1, "\"../parts/");
  folder.write("parts/" + second.filename().string(), elsewhere);
  expect({"part-2-of-3.manifest.json", "../parts/part-2-of-3.frames.csv"});
  fs::remove(second);
  expect({"part 2 of 3 is missing"});
  folder.write("parts/" + second.filename().string(), manifest);
  fs::copy_file(second, parts / "part-1-of-3.manifest.json", fs::copy_options::overwrite_existing);
  expect({"part-1-of-3.manifest.json", "part 2 of 3"});
  fs::remove(parts / "part-1-of-3.manifest.json");
  EXPECT_EQ(part(1, 3).code, 0);

  // A recording that was changed meanwhile, one of other parts.
  folder.write("people.txt", crossing_people() + "90 60 9 0 1.7\n");
  EXPECT_EQ(part(3, 3).code, 0);
  expect({"part-3-of-3.manifest.json", "another run", "inputs"});
  folder.write("people.txt", crossing_people());
  EXPECT_EQ(part(3, 3).code, 0);
  EXPECT_EQ(part(1, 4).code, 0);
  expect({"part-1-of-4", "one of"});
  fs::remove(parts / "part-1-of-4.manifest.json");
  EXPECT_EQ(bch({"merge", parts, "--json", json, "--fail-above", "1"}).code, 1);
}

/// What a manifest says of a file.
nlohmann::ordered_json identity_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const auto [bytes, checksum] = detail::baked::checksum(stream);
  return {{"file", file.filename().string()}, {"bytes", bytes}, {"xxh3", fmt::format("{:016x}", checksum)}};
}

/// A summary whose counts are fractions, negative or too large is refused, also where the manifest has its checksum.
TEST_F(CliParts, HaveWholeNumbersForCounts) {
  do_parts({"check", file}, 1, parts);
  const std::string name = "part-1-of-1.summary.json",
                    manifest = read_text(parts / "part-1-of-1.manifest.json"),
                    summary = read_text(parts / name);
  for (const char* const member : {"rows", "people", "first_frame"})
    for (const char* const number : {"1e308", "1.5", "-1.0", "null", "18446744073709551616"}) {
      std::string damaged = summary;
      const std::size_t begin = damaged.find(':', damaged.find(fmt::format("\"{}\"", member))) + 1;
      damaged.replace(begin, damaged.find_first_of(",}", begin) - begin, number);
      folder.write("parts/" + name, damaged);
      nlohmann::ordered_json vouching = nlohmann::ordered_json::parse(manifest);
      for (auto& each : vouching["files"])
        if (each["file"] == name) each = identity_of(parts / name);
      folder.write("parts/part-1-of-1.manifest.json", vouching.dump());
      expect_failure(bch({"merge", parts}), 3, {name, "is damaged"});
    }
}

/// What is in a folder, without hidden files.
std::size_t shown_files(const fs::path& folder) {
  std::size_t count = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    count += entry.path().filename().string()[0] != '.';
  return count;
}

TEST_F(CliParts, LeaveNothingHalfDoneOnAFullDisk) {
  EXPECT_EQ(part(1, 2).code, 0);
  for (const std::size_t bytes : {200, 2'500}) {
    Streams streams;
    streams.largest_file = bytes;
    expect_failure(part(2, 2, streams), 3, {"part-2-of-2"});
    EXPECT_FALSE(fs::exists(parts / "part-2-of-2.manifest.json"));
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(parts))
    EXPECT_NE(entry.path().filename().string()[0], '.') << entry;
  expect_failure(bch({"merge", parts}), 3, {"part 2 of 2 is missing"});
  expect_whole_after(2);
}

TEST_F(CliParts, ThatAreKilledAreDoneAgain) {
  EXPECT_EQ(part(1, 2).code, 0);
  const std::size_t before = shown_files(parts);
  const auto writes = [&] {
    return std::ranges::any_of(fs::directory_iterator(parts),
                               [](const auto& entry) { return entry.path().filename().string()[0] == '.'; });
  };
  EXPECT_EQ(run_until(writes, SIGKILL, BCH_PROGRAM, {"check", file, "--part", "2/2", "--into", parts}),
            -SIGKILL);
  EXPECT_EQ(shown_files(parts), before);
  expect_failure(bch({"merge", parts}), 3, {"part 2 of 2 is missing"});
  expect_whole_after(2);
}

TEST_F(CliParts, OfBadInputAreNotWritten) {
  EXPECT_EQ(part(1, 2).code, 0);
  const std::size_t before = shown_files(parts);
  folder.write("people.txt", crossing_people() + "90 59 9 0 1.7\n");
  expect_failure(part(2, 2), 3, {"people.txt"});
  EXPECT_EQ(shown_files(parts), before);
  folder.write("people.txt", crossing_people());
  EXPECT_EQ(part(2, 2).code, 0);
  EXPECT_EQ(bch({"merge", parts}).code, 0);
}

// ---- Files of parts and tables: what they may not overwrite, what is no part, what a signal leaves.

/// Nested arrays or objects, deep enough to exhaust the stack of what recurses.
std::string nested(const char* open, const char* middle, const char* close) {
  std::string text;
  for (int i = 0; i < 300'000; ++i) text += open;
  text += middle;
  for (int i = 0; i < 300'000; ++i) text += close;
  return text;
}

class CliPartFiles : public CliParts {
 protected:
  Ending do_all() const { return part(1, 1); }
  std::string part_file(const std::string& kind) const { return parts / ("part-1-of-1." + kind); }
};

TEST_F(CliPartFiles, OverwriteNoInput) {
  fs::create_directory(parts);
  const std::string agents = folder.write("agents.csv", four_agents),
                    pairs = folder.write("pairs.csv", "first,second\na,b\n");
  for (const std::string kind : {"frames.csv", "pairs.csv", "events.csv", "summary.json", "manifest.json"}) {
    const std::string taken = part_file(kind);
    const auto expect = [&] {
      expect_failure(do_all(), 2, {"--into: " + taken, file + ", an input"});
      EXPECT_EQ(read_text(file), crossing_people()) << kind;
      fs::remove(taken);
    };
    fs::create_symlink(file, taken), expect();
    fs::create_hard_link(file, taken), expect();
    folder.write("parts/part-1-of-1." + kind, crossing_people());
    expect_failure(bch({"check", taken, "--part", "1/1", "--into", parts}), 2, {"--into: " + taken});
    EXPECT_EQ(read_text(taken), crossing_people());
    fs::remove(taken);
  }
  for (const std::string kind : {"answers.csv", "manifest.json"}) {
    fs::create_symlink(agents, part_file(kind));
    expect_failure(bch({"query", "default:male", agents, pairs, "--part", "1/1", "--into", parts}), 2,
                   {"--into: " + part_file(kind), agents + ", an input"});
    EXPECT_EQ(read_text(agents), four_agents);
    fs::remove(part_file(kind));
  }
  EXPECT_EQ(do_all().code, 0);
}

TEST_F(CliPartFiles, ThatNestDeeplyAreRefused) {
  ASSERT_EQ(do_all().code, 0);
  for (const std::string& deep : {nested("[", "", "]"), nested("{\"a\":", "1", "}")})
    for (const char* const kind : {"manifest.json", "summary.json"}) {
      const std::string before = read_text(part_file(kind));
      folder.write(fmt::format("parts/part-1-of-1.{}", kind),
                   "{\"bch_part\":1,\"part\":1,\"of\":1,\"files\":[],\"run\":" + deep + "}");
      expect_failure(bch({"merge", parts}), 3, {part_file(kind)});
      EXPECT_EQ(do_all().code, 0);
      EXPECT_EQ(read_text(part_file(kind)), before);
    }
}

TEST_F(CliPartFiles, AreWrittenToNoPipe) {
  fs::create_directory(parts);
  ASSERT_EQ(mkfifo(part_file("frames.csv").c_str(), 0600), 0);
  expect_failure(do_all(), 3, {part_file("frames.csv"), "not a regular file"});
}

TEST_F(CliPartFiles, ThatAreNoneAreRefusedByALine) {
  fs::create_directory(parts);
  const std::string manifest = part_file("manifest.json");
  ASSERT_EQ(mkfifo(part_file("answers.csv").c_str(), 0600), 0);
  folder.write("parts/part-1-of-1.manifest.json",
               R"({"bch_part":1,"part":1,"of":1,"share":{},"run":{"command":"query"},)"
               R"("files":[{"file":"part-1-of-1.answers.csv","bytes":0,"xxh3":"0"}]})");
  expect_failure(bch({"merge", parts}), 3, {part_file("answers.csv")});
  fs::remove(manifest);
  fs::create_directory(manifest);
  expect_failure(bch({"merge", parts}), 3, {manifest});
  fs::remove(manifest);
  ASSERT_EQ(mkfifo(manifest.c_str(), 0600), 0);
  expect_failure(bch({"merge", parts}), 3, {manifest, "not a regular file"});
  fs::remove(manifest);
  fs::create_symlink("/dev/zero", manifest);
  expect_failure(bch({"merge", parts}), 3, {manifest, "not a regular file"});
}

TEST_F(CliPartFiles, AllGoWithASignal) {
  folder.write("people.txt", crossing_people(30'000));
  const fs::path out = folder.file("out");
  fs::create_directory(out);
  const auto files = [&] { return std::distance(fs::directory_iterator(out), {}); };
  const Arguments tables{"check", file, "--events", out / "e", "--frames", out / "f", "--pairs", out / "p"},
      part{"check", file, "--part", "1/1", "--into", out};
  for (const int number : {SIGINT, SIGTERM, SIGHUP})
    for (const Arguments& command : {tables, part}) {
      const int many = command == tables ? 3 : 4;
      EXPECT_EQ(run_until([&] { return files() >= many; }, number, BCH_PROGRAM, command), 128 + number);
      EXPECT_EQ(files(), 0) << number;
    }
}

}  // namespace
}  // namespace bch::test
