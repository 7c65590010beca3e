// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/base/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>

namespace bch::detail {
namespace {

[[noreturn]] void fail(const char* what) {
  throw std::runtime_error(std::string(what) + ": " + std::strerror(errno));
}

void limit(decltype(RLIMIT_CPU) resource, rlim_t value) {
  const rlimit both{value, value};
  setrlimit(resource, &both);
}

#ifndef BCH_SANITIZED  // whose shadow memory alone is larger than any limit
/// Bytes of address space of this process: what it shares with its parent after a fork, the parent's shapes included.
std::size_t address_space() {
  std::ifstream statm("/proc/self/statm");
  std::size_t pages = 0;
  statm >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}
#endif

void set_limits(const ChildLimits& limits) {
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, 0);  // it has nothing to write
  // The parent counts the time; this is for a child whose parent is stopped.
  limit(RLIMIT_CPU, static_cast<rlim_t>(limits.cpu_time.count() / 1000 + 1));
#ifndef BCH_SANITIZED
  limit(RLIMIT_AS, address_space() + limits.memory);
#endif
}

/// Gives signals their default effect again, for a child that has none of what its parent's handlers need. Those that
/// terminals send to both are for the parent.
void reset_signal_handlers() {
  for (int number = 1; number <= SIGRTMAX; ++number)
    if (number != SIGKILL && number != SIGSTOP) signal(number, SIG_DFL);
  for (const int number : {SIGINT, SIGHUP, SIGTSTP, SIGXFSZ}) signal(number, SIG_IGN);
}

[[noreturn]] void run_child(const ChildLimits& limits, const std::function<void(int to)>& run, int to) {
  if (limits.ends_with_thread) prctl(PR_SET_PDEATHSIG, SIGKILL);
  reset_signal_handlers();
  // The parent speaks for both.
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  set_limits(limits);
  run(to);
  _exit(0);  // without destructors: a damaged heap must not undo the answer
}

}  // namespace

ChildProcess::ChildProcess(const ChildLimits& limits, const std::function<void(int to)>& run) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) fail("no pipe");
  pid_ = fork();
  if (pid_ == 0) {
    close(ends[0]);
    run_child(limits, run, ends[1]);
  }
  const int error = errno;
  from_ = ends[0];
  close(ends[1]);
  if (pid_ > 0) return;
  close(from_);
  errno = error;
  fail("no child process");
}

ChildProcess::~ChildProcess() {
  close(from_);
  if (pid_ <= 0) return;
  kill(pid_, SIGKILL);
  while (waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) continue;
}

std::optional<std::size_t> ChildProcess::read(std::span<char> bytes,
                                              std::chrono::milliseconds patience) const {
  pollfd waiting{from_, POLLIN, 0};
  const int ready = poll(&waiting, 1, static_cast<int>(patience.count()));
  if (ready == 0) return std::nullopt;
  const ssize_t got = ready < 0 ? -1 : ::read(from_, bytes.data(), bytes.size());
  if (got < 0 && errno == EINTR) return std::nullopt;
  if (got < 0) fail("the child process was lost");
  return static_cast<std::size_t>(got);
}

int ChildProcess::wait() {
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0)
    if (errno == ECHILD)
      break;
    else if (errno != EINTR)
      fail("the child process was lost");
  pid_ = 0;
  return status;
}

void write_or_exit(int to, std::span<const char> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(to, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) _exit(1);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

}  // namespace bch::detail
