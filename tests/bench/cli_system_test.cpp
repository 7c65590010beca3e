// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <signal.h>

#include "tests/support/bch_run.hpp"
#include "tests/support/test.hpp"

// What the system does to the program: signals, streams that are closed, a small stack.

namespace bch::test {
namespace {

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
