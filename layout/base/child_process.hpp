// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>

namespace bch::detail {

/// Limits what a child process may use, and for how long it lives.
struct ChildLimits {
  std::chrono::milliseconds cpu_time{60'000};
  /// Bytes of address space beyond what this process has when the child begins. Builds with sanitizers, which need
  /// far more, set no such limit.
  std::size_t memory = std::size_t{1} << 30;
  bool ends_with_thread = false;  ///< with the one that made it, too
};

/// Runs a child process that reads what is not trusted, and says through a pipe what it found. It writes to nothing else, and is ended and
/// waited for at the latest when this goes.
/// Errors:  throws std::runtime_error where there can be no child.
/// Threads: the child has the caller's thread alone. A lock of a library other than the C library that another thread holds at that
///          moment, stays locked there.
class ChildProcess {
 public:
  /// Calls `run` in the child, with the end of the pipe to write to; the child ends with status 0 when it returns.
  ChildProcess(const ChildLimits& limits, const std::function<void(int to)>& run);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Reads what the child says, as soon as it says something.
  /// Returns: the number of bytes, 0 when it has ended; nothing where it says nothing for that long.
  std::optional<std::size_t> read(std::span<char> bytes, std::chrono::milliseconds patience) const;

  /// Waits for its end.
  /// Returns: its status; 0 where the program ignores SIGCHLD, which hides the status.
  int wait();

 private:
  pid_t pid_ = 0;
  int from_ = -1;
};

/// Writes bytes to a pipe; for the child, which ends where it cannot.
void write_or_exit(int to, std::span<const char> bytes);

}  // namespace bch::detail
