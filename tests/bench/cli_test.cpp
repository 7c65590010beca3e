// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <signal.h>

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

/// The figures of chapters are what the laboratory draws now, legible by any program.
TEST(Cli, FiguresAreWhatTheLaboratoryDraws) {
  const std::string program = std::filesystem::path(BCH_PROGRAM).parent_path() / "bch_lab";
  if (!std::filesystem::exists(program)) GTEST_SKIP() << "bch_lab is not built";
  const TemporaryFolder folder;
  const Ending run = run_program(program, {"figures", "--out", folder.path().string()});
  ASSERT_EQ(run.code, 0) << run.err;
  const std::filesystem::path bench = std::filesystem::path(__FILE__).parent_path() / "../../bench";
  for (const std::string name : {"stages.svg", "distances.svg", "motion.svg"}) {
    EXPECT_TRUE(has(run.out, name));
    const std::string svg = read_text(folder.file(name));
    EXPECT_TRUE(svg == read_text(bench / name)) << "bch_lab figures --out bench draws another " << name;
    EXPECT_TRUE(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
    EXPECT_LT(svg.size(), 60'000u);
    EXPECT_EQ(count_of(svg, "<g"), count_of(svg, "</g>"));
    EXPECT_TRUE(has(svg, "prefers-color-scheme: dark"));
    for (const char* const number : {"nan", "inf"}) EXPECT_EQ(count_of(svg, number), 0u);
  }
}

TEST(Cli, OutputThatCannotBeWrittenIsReported) {
  expect_failure(bch({"--version"}, {}, {"/dev/full", {}}), 3, {"standard output"});
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
  EXPECT_EQ(folder.files(), 1);
}

// ---- What the system does to the program: signals, streams that are closed, a small stack.

namespace fs = std::filesystem;

std::vector<int> ending_signals() {
  std::vector<int> all{SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1, SIGUSR2, SIGPIPE, SIGALRM};
#ifndef BCH_SANITIZED  // which catch crashes themselves
  all.insert(all.end(), {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGSYS, SIGXCPU, SIGVTALRM,
                         SIGPROF, SIGIO, SIGRTMIN, SIGRTMAX});
#endif
  return all;
}

TEST(CliSystem, EverySignalThatCanBeCaughtLeavesNoFile) {
  for (const int number : ending_signals()) {
    SCOPED_TRACE(number);
    const TemporaryFolder folder;
    const int code = run_until([&] { return !fs::is_empty(folder.path()); }, number, BCH_PROGRAM,
                               {"bake", "default:male", "--poses", "900000", "-o", folder.file("a.bch")});
    const bool asked = number == SIGINT || number == SIGTERM || number == SIGHUP;
    EXPECT_EQ(code, asked ? 128 + number : -number);
    EXPECT_TRUE(fs::is_empty(folder.path()));
  }
}

/// Runs bch from a shell, which sets something up first.
Ending after(const std::string& setup, const Arguments& arguments, const std::string& redirections = {}) {
  Arguments all{"-c", setup + " exec \"$0\" \"$@\" " + redirections, BCH_PROGRAM};
  all.insert(all.end(), arguments.begin(), arguments.end());
  return run_program("/bin/sh", all);
}

/// Otherwise the pipe from the importing process would be standard input and output.
TEST(CliSystem, StandardStreamsMayBeClosed) {
  const TemporaryFolder folder;
  const std::string model = folder.write("box.obj", box), json = folder.file("a.json");
  const Ending alone = bch({"inspect", model, "--json", json}, as_metres);
  ASSERT_EQ(alone.code, 0) << alone.err;
  const std::string expected = read_text(json);
  for (const std::string closed : {"<&-", ">&-", "<&- >&-", "<&- >&- 2>&-", ">&- 2>&-"}) {
    SCOPED_TRACE(closed);
    fs::remove(json);
    Arguments arguments{"inspect", model, "--json", json};
    arguments.insert(arguments.end(), as_metres.begin(), as_metres.end());
    const Ending run = after("", arguments, closed);
    EXPECT_EQ(read_text(json), expected);
    const bool says = closed.find(">&-") == std::string::npos;
    EXPECT_EQ(run.code, says ? 0 : 3) << run.err;
    EXPECT_EQ(run.out, says ? alone.out : "");
    if (!says && closed.find("2>") == std::string::npos) {
      EXPECT_EQ(run.err, "bch: standard output: cannot be written: Bad file descriptor\n");
    }
  }
}

#ifndef BCH_SANITIZED  // which need a larger stack themselves
TEST(CliSystem, SmallStacksAreRefused) {
  const Arguments crowd{"crowd", "--agents", "100", "--poses", "1"};
  const Ending run = after("ulimit -s 64;", crowd);
  EXPECT_EQ(run.code, 2);
  EXPECT_EQ(run.err, "bch: the stack is limited to 64 KiB (ulimit -s), and 320 are needed\n");
  EXPECT_EQ(after("ulimit -s 320;", crowd).code, 0);
}
#endif

}  // namespace
}  // namespace bch::test
