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

/// Limits the resources and the lifetime of a child process.
struct ChildLimits {
  std::chrono::milliseconds cpu_time{60'000};
  /// Bytes of address space beyond those of this process when the child begins. Builds with sanitizers need far more
  /// and set no such limit.
  std::size_t memory = std::size_t{1} << 30;
  bool ends_with_thread = false;  ///< whether the child also ends with the thread that created it
};

/// Runs a child process that reads untrusted data and sends results through a pipe. The child writes to nothing else.
/// The destructor kills and reaps it.
/// Errors:  throws std::runtime_error if no child can be created.
/// Threads: the child has only the caller's thread. A lock that another thread holds at the fork stays locked in the
///          child, except the C library's own.
class ChildProcess {
 public:
  /// Calls `run` in the child with the write end of the pipe. The child ends with status 0 when `run` returns.
  ChildProcess(const ChildLimits& limits, const std::function<void(int to)>& run);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Reads what the child sends, as soon as something arrives.
  /// Returns: the number of bytes; 0 if the child has ended; nothing if no bytes arrive within `patience`.
  std::optional<std::size_t> read(std::span<char> bytes, std::chrono::milliseconds patience) const;

  /// Waits until the child ends.
  /// Returns: the status of the child, or 0 if the program ignores SIGCHLD, which hides the status.
  int wait();

 private:
  pid_t pid_ = 0;
  int from_ = -1;
};

/// Writes bytes to a pipe. Called in the child, which exits if writing fails.
void write_or_exit(int to, std::span<const char> bytes);

}  // namespace bch::detail
