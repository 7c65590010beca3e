// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace bch::cli {

enum ExitCode : int {
  exit_success = 0,
  exit_failed = 1,     ///< a check that failed, as its user asked for
  exit_usage = 2,      ///< the command line makes no sense
  exit_bad_input = 3,  ///< a file cannot be read, believed or written
  exit_internal = 4,   ///< a fault of the program, or no memory left
  exit_signal = 128,   ///< plus the signal's number: 130 for an interrupt
};

/// Reports an error in the command line, which leads to exit_usage. The message is one line.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reports a check that failed, which leads to exit_failed. The message is one line.
class CheckFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reports an error in a file, which leads to exit_bad_input. The message is one line that names the file.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reports the errors of several bad files, which lead to exit_bad_input: a line for each file.
class InputErrors : public std::runtime_error {
 public:
  /// Takes one line at least.
  explicit InputErrors(std::vector<std::string> each)
      : std::runtime_error(each.front()), lines(std::move(each)) {}
  std::vector<std::string> lines;
};

/// Runs a program. What it throws becomes a line on standard error, or one for each bad file, and an ExitCode.
/// Standard streams that the caller closed stay unusable, but no file or pipe takes their numbers.
/// Returns: the exit code.
int run_main(const char* program, const std::function<int()>& run);

}  // namespace bch::cli
