// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <nlohmann/json.hpp>

#include "tests/support/bch_run.hpp"
#include "tests/support/test.hpp"

namespace bch {
namespace {

using test::Arguments;
using test::Ending;

/// What mpirun needs as root, and with more ranks than cores.
const Arguments mpirun{"--allow-run-as-root", "--oversubscribe"};

Ending run(const Arguments& arguments) {
  Arguments all = mpirun;
  all.insert(all.end(), arguments.begin(), arguments.end());
  return test::run_program(BCH_MPIRUN, all);
}

/// Expects a code and one line of a program that begins so.
void expect_one_line(const Ending& ending, int code, const std::string& line,
                     const std::string& program = "bch_mpi: ") {
  EXPECT_EQ(ending.code, code) << ending.err;
  const std::size_t at = ending.err.find(program);
  ASSERT_NE(at, std::string::npos) << ending.err;
  EXPECT_EQ(ending.err.find(program + line), at) << ending.err;
  EXPECT_EQ(ending.err.find(program, at + 1), std::string::npos) << ending.err;
}

void expect_killed(const Ending& ending) {
  EXPECT_NE(ending.code, 0);
  for (const char* const word : {"rank 1", "signal 9"}) EXPECT_TRUE(test::has(ending.err, word));
}

class BchMpi : public testing::Test {
 protected:
  void SetUp() override {
    const Ending baked = test::bch({"bake", "default:male", "--poses", "6", "-o", people});
    ASSERT_EQ(baked.code, 0) << baked.err;
  }

  Arguments crowd(const std::string& ranks, const Arguments& more = {}) const {
    Arguments all{"-n", ranks, BCH_MPI_PROGRAM, "crowd", people, "--agents", "2000", "--steps", "2"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  TemporaryFolder folder;
  const std::string people = folder.file("people.bch").string();
  const std::string report = folder.file("report.json").string();
};

TEST_F(BchMpi, ReportsOfEveryRankWhatItDid) {
  for (const std::string kind : {"spot", "stadium", "street"}) {
    const Ending plain = run(crowd("1", {"--kind", kind, "--plain", "--json", report}));
    ASSERT_EQ(plain.code, 0) << plain.err;
    const nlohmann::json expected = test::read_json(report);
    const Ending three = run(crowd("3", {"--kind", kind, "--json", report}));
    ASSERT_EQ(three.code, 0) << three.err;
    const nlohmann::json found = test::read_json(report);
    EXPECT_GT(expected["collisions"], 100);
    EXPECT_EQ(found["collisions"], expected["collisions"]);
    EXPECT_EQ(found["digest"], expected["digest"]);
    EXPECT_EQ(found["agents"], 2000);
    EXPECT_EQ(found["ranks"].size(), 3u);
    EXPECT_NE(three.out.find("2 000 agents on 3 ranks"), std::string::npos) << three.out;
    EXPECT_NE(three.out.find("digest " + found["digest"].get<std::string>()), std::string::npos);
  }
}

TEST_F(BchMpi, AFileThatOneRankCannotReadEndsAllWithOneLine) {
  Arguments both = crowd("1");
  for (const char* const word : {":", "-n", "1", BCH_MPI_PROGRAM, "crowd", "nowhere.bch"})
    both.emplace_back(word);
  const Ending run_of_both = run(both);
  expect_one_line(run_of_both, 3, "rank 1: nowhere.bch");
  EXPECT_EQ(run_of_both.out, "");
}

TEST_F(BchMpi, WhatElseIsWrongIsOneLine) {
  expect_one_line(run(crowd("2", {"--json", "/dev/full"})), 3, "rank 0: /dev/full");
  expect_one_line(run({"-n", "3", BCH_MPI_PROGRAM, "fly"}), 2, "");
}

TEST(FailingRank, ThatThrowsOrIsKilledEndsAll) {
  expect_one_line(run({"-n", "3", BCH_FAILING_RANK, "throw"}), 7, "rank 1: the simulator has a fault",
                  "failing_rank: ");
  expect_killed(run({"-n", "3", BCH_FAILING_RANK, "kill"}));
}

TEST(FailingRank, ThatInitialisesMpiForNoThreadsIsRefusedWithALine) {
  const Ending ending = run({"-n", "1", BCH_FAILING_RANK, "without_threads"});
  EXPECT_EQ(ending.code, 7) << ending.err;
  const std::string line =
      "failing_rank: MPI provides MPI_THREAD_SINGLE, and MPI_THREAD_FUNNELED is needed: "
      "threads of TBB compute beside it\n";
  EXPECT_TRUE(ending.err.starts_with(line)) << ending.err;
}

// ---- `bch_mpi check`.

namespace fs = std::filesystem;

/// People who walk up and down, so many that a part of a hundred frames takes a tenth of a second.
std::string walking_people() {
  std::ostringstream text;
  text << "# framerate: 10\n# id frame x/m y/m z/m\n";
  for (int k = 0; k < 1200; ++k)
    for (int id = 0; id < 12; ++id)
      text << id << " " << k << " " << 5 * std::sin(0.02 * k + id) << " " << 0.4 * id << " 1.75\n";
  return text.str();
}

class BchMpiCheck : public testing::Test {
 protected:
  Arguments check(const std::string& ranks, const std::string& file, const Arguments& more = {}) const {
    Arguments all{"-n", ranks, BCH_MPI_PROGRAM, "check", file, "--into", parts, "--json", json};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  TemporaryFolder folder;
  const std::string recording = folder.write("people.txt", test::two_who_meet());
  const std::string parts = folder.file("parts"), json = folder.file("check.json");
};

TEST_F(BchMpiCheck, WritesWhatOneProcessWrites) {
  const std::string expected_json = folder.file("expected.json");
  const Ending expected = test::bch({"check", recording, "--json", expected_json});
  for (const char* const ranks : {"1", "3"}) {
    const Ending found = run(check(ranks, recording));
    EXPECT_EQ(found.code, 0) << found.err;
    EXPECT_EQ(found.out, expected.out);
    EXPECT_EQ(test::read_text(json), test::read_text(expected_json));
  }
  // Parts that bch did need not be done again.
  for (const char* const part : {"1/5", "2/5", "3/5", "4/5"})
    EXPECT_EQ(test::bch({"check", recording, "--part", part, "--into", parts}).code, 0);
  const auto before = fs::last_write_time(fs::path(parts) / "part-2-of-5.manifest.json");
  EXPECT_EQ(run(check("2", recording, {"--parts", "5"})).out, expected.out);
  EXPECT_EQ(fs::last_write_time(fs::path(parts) / "part-2-of-5.manifest.json"), before);
  expect_one_line(run(check("2", recording, {"--fail-above", "1"})), 1, recording);
}

TEST_F(BchMpiCheck, FaultsOfOneRankEndAllWithOneLineAndKeepParts) {
  Arguments both = check("1", recording);
  for (const std::string& word : check("1", folder.file("absent.txt"))) {
    if (word == "-n") both.emplace_back(":");
    both.push_back(word);
  }
  expect_one_line(run(both), 3, "rank 1: " + folder.file("absent.txt").string());
  EXPECT_TRUE(fs::exists(fs::path(parts) / "part-1-of-2.manifest.json"));
  EXPECT_FALSE(fs::exists(fs::path(parts) / "part-2-of-2.manifest.json"));
  EXPECT_FALSE(fs::exists(json));
  expect_one_line(run(check("2", recording, {"--frames", "/dev/full"})), 3, "rank 0: /dev/full");
  EXPECT_FALSE(fs::exists(json));
  EXPECT_EQ(run(check("2", recording)).code, 0);
}

/// The commands of two ranks: of rank 1 a shell that runs `before`, and becomes it.
Arguments with_shell(const Arguments& command, const std::string& before) {
  Arguments both{"-n", "1"};
  both.insert(both.end(), command.begin() + 2, command.end());
  for (const char* const word : {":", "-n", "1", "sh", "-c"}) both.emplace_back(word);
  both.push_back(before + "\nexec \"$@\"");
  both.emplace_back("sh");
  both.insert(both.end(), command.begin() + 2, command.end());
  return both;
}

TEST_F(BchMpiCheck, AKilledRankEndsAllAndPartsAreNotDoneAgain) {
  const std::string file = folder.write("walking.txt", walking_people()),
                    expected_json = folder.file("one.json");
  const Arguments command = check("2", file, {"--parts", "12"});
  const std::string first_done = (fs::path(parts) / "part-2-of-12.manifest.json").string();
  const Ending killed =
      run(with_shell(command, "(until [ -e '" + first_done + "' ]; do sleep 0.01; done; kill -9 $$) &"));
  expect_killed(killed);
  EXPECT_EQ(killed.out, "");
  EXPECT_FALSE(fs::exists(json));

  std::map<fs::path, fs::file_time_type> done;
  for (const fs::directory_entry& entry : fs::directory_iterator(parts))
    if (entry.path().string().ends_with(".manifest.json")) done[entry.path()] = entry.last_write_time();
  EXPECT_GE(done.size(), 1u);
  EXPECT_LT(done.size(), 12u);
  const Ending resumed = run(command), expected = test::bch({"check", file, "--json", expected_json});
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_EQ(resumed.out, expected.out);
  EXPECT_EQ(test::read_text(json), test::read_text(expected_json));
  for (const auto& [manifest, written] : done) EXPECT_EQ(fs::last_write_time(manifest), written) << manifest;
}

/// The one rank is signalled itself: mpirun may end others by SIGKILL before they have cleaned up.
TEST_F(BchMpiCheck, ASignalLeavesNoTemporaryFile) {
  const std::string file = folder.write("walking.txt", walking_people());
  const std::string writes = "ls -A '" + parts + "' 2>/dev/null | grep -q '^[.]bch'";
  Arguments command{
      "-n", "1", "sh", "-c", "(until " + writes + "; do sleep 0.01; done; kill -TERM $$) &\nexec \"$@\"",
      "sh"};
  const Arguments plain = check("1", file);
  command.insert(command.end(), plain.begin() + 2, plain.end());
  EXPECT_NE(run(command).code, 0);
  EXPECT_FALSE(fs::exists(json));
  ASSERT_TRUE(fs::exists(parts));
  EXPECT_TRUE(fs::is_empty(parts));
}

TEST_F(BchMpiCheck, AFullDiskOfOneRankEndsAllWithOneLine) {
  Arguments command = with_shell(check("2", recording), "ulimit -f 0");
  command.insert(command.begin(), {"--mca", "btl", "self,tcp"});  // whose memory is not shared by a file
  expect_one_line(run(command), 3, "rank 1: " + (fs::path(parts) / "part-2-of-2").string());
  EXPECT_TRUE(fs::exists(fs::path(parts) / "part-1-of-2.manifest.json"));
  EXPECT_FALSE(fs::exists(fs::path(parts) / "part-2-of-2.manifest.json"));
  EXPECT_FALSE(fs::exists(json));
}

}  // namespace
}  // namespace bch
