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

}  // namespace
}  // namespace bch
