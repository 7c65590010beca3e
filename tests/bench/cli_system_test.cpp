// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "tests/support/bch_run.hpp"
#include "tests/support/temporary_folder.hpp"

// What the system does to the program: signals, streams that are closed, a small stack.

namespace bch::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

/// Starts a bake that takes minutes. Returns: its process.
pid_t start_baking(const std::string& file, int signal_to_expect) {
  const pid_t child = fork();
  if (child != 0) return child;
  signal(signal_to_expect, SIG_DFL);  // test runners may ignore it, which children inherit
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  const int nowhere = open("/dev/null", O_RDWR);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  execl(BCH_PROGRAM, BCH_PROGRAM, "bake", "default:male", "--poses", "900000", "-o", file.c_str(), nullptr);
  _exit(127);
}

bool wait_for_a_file(const fs::path& folder) {
  for (int tries = 0; tries < 6000 && fs::is_empty(folder); ++tries) std::this_thread::sleep_for(5ms);
  return !fs::is_empty(folder);
}

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
    const pid_t child = start_baking(folder.file("a.bch"), number);
    EXPECT_TRUE(wait_for_a_file(folder.path()));
    kill(child, number);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(fs::is_empty(folder.path()));
    if (number == SIGINT || number == SIGTERM || number == SIGHUP)
      EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 128 + number) << status;
    else
      EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == number) << status;
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
