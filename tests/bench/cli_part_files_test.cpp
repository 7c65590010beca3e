// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>

#include "tests/support/bch_run.hpp"
#include "tests/support/test.hpp"

// Files of parts and tables: what they may not overwrite, what is no part, what a signal leaves.

namespace bch::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kinds[] = {"frames.csv", "pairs.csv", "events.csv", "summary.json", "manifest.json"};

std::string two_people(int frames = 20) {
  std::string text = "# framerate: 10\n# id frame x/m y/m z/m\n";
  for (int k = 0; k < frames; ++k) text += fmt::format("1 {0} 0 0 1.7\n2 {0} 0.1 0 1.8\n", k);
  return text;
}

/// Nested arrays or objects, deep enough to exhaust the stack of what recurses.
std::string nested(const char* open, const char* middle, const char* close) {
  std::string text;
  for (int i = 0; i < 300'000; ++i) text += open;
  text += middle;
  for (int i = 0; i < 300'000; ++i) text += close;
  return text;
}

class CliPartFiles : public testing::Test {
 protected:
  Ending do_part() const { return bch({"check", people, "--part", "1/1", "--into", parts}); }
  std::string part(const std::string& kind) const { return parts + "/part-1-of-1." + kind; }

  const TemporaryFolder folder;
  const std::string people = folder.write("people.txt", two_people()), parts = folder.file("parts");
};

TEST_F(CliPartFiles, OverwriteNoInput) {
  fs::create_directory(parts);
  const std::string agents = folder.write("agents.csv", four_agents),
                    pairs = folder.write("pairs.csv", "first,second\na,b\n");
  for (const std::string kind : kinds) {
    const std::string file = part(kind);
    const auto expect = [&] {
      expect_failure(do_part(), 2, {"--into: " + file, people + ", an input"});
      EXPECT_EQ(read_text(people), two_people()) << kind;
      fs::remove(file);
    };
    fs::create_symlink(people, file), expect();
    fs::create_hard_link(people, file), expect();
    folder.write("parts/part-1-of-1." + kind, two_people());
    expect_failure(bch({"check", file, "--part", "1/1", "--into", parts}), 2, {"--into: " + file});
    EXPECT_EQ(read_text(file), two_people());
    fs::remove(file);
  }
  for (const std::string kind : {"answers.csv", "manifest.json"}) {
    fs::create_symlink(agents, part(kind));
    expect_failure(bch({"query", "default:male", agents, pairs, "--part", "1/1", "--into", parts}), 2,
                   {"--into: " + part(kind), agents + ", an input"});
    EXPECT_EQ(read_text(agents), four_agents);
    fs::remove(part(kind));
  }
  EXPECT_EQ(do_part().code, 0);
}

TEST_F(CliPartFiles, ThatNestDeeplyAreRefused) {
  ASSERT_EQ(do_part().code, 0);
  for (const std::string& deep : {nested("[", "", "]"), nested("{\"a\":", "1", "}")})
    for (const char* const kind : {"manifest.json", "summary.json"}) {
      const std::string before = read_text(part(kind));
      folder.write(fmt::format("parts/part-1-of-1.{}", kind),
                   "{\"bch_part\":1,\"part\":1,\"of\":1,\"files\":[],\"run\":" + deep + "}");
      expect_failure(bch({"merge", parts}), 3, {part(kind)});
      EXPECT_EQ(do_part().code, 0);
      EXPECT_EQ(read_text(part(kind)), before);
    }
}

TEST_F(CliPartFiles, AreWrittenToNoPipe) {
  fs::create_directory(parts);
  ASSERT_EQ(mkfifo(part("frames.csv").c_str(), 0600), 0);
  expect_failure(do_part(), 3, {part("frames.csv"), "not a regular file"});
}

TEST_F(CliPartFiles, ThatAreNoneAreRefusedByALine) {
  fs::create_directory(parts);
  const std::string manifest = part("manifest.json");
  ASSERT_EQ(mkfifo(part("answers.csv").c_str(), 0600), 0);
  folder.write("parts/part-1-of-1.manifest.json",
               R"({"bch_part":1,"part":1,"of":1,"share":{},"run":{"command":"query"},)"
               R"("files":[{"file":"part-1-of-1.answers.csv","bytes":0,"xxh3":"0"}]})");
  expect_failure(bch({"merge", parts}), 3, {part("answers.csv")});
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
  folder.write("people.txt", two_people(150'000));
  const fs::path out = folder.file("out");
  fs::create_directory(out);
  const auto files = [&] { return std::distance(fs::directory_iterator(out), {}); };
  const Arguments tables{"check", people, "--events", out / "e", "--frames", out / "f", "--pairs", out / "p"},
      part{"check", people, "--part", "1/1", "--into", out};
  for (const int number : {SIGINT, SIGTERM, SIGHUP})
    for (const Arguments& command : {tables, part}) {
      const int many = command == tables ? 3 : 4;
      EXPECT_EQ(run_until([&] { return files() >= many; }, number, BCH_PROGRAM, command), 128 + number);
      EXPECT_EQ(files(), 0) << number;
    }
}

}  // namespace
}  // namespace bch::test
