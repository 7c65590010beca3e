// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace bch::cli {

/// Represents what a program does when somebody asks it to end by SIGINT, SIGTERM or SIGHUP.
enum class OnRequest {
  say_so,  ///< it writes a line, and ends with exit code 128 + signal
  end,     ///< it ends by the signal: mpirun asks all ranks, and tells it itself
};

/// Makes every signal that ends the program, and can be caught, remove all files under construction first. Signals that
/// are no requests, crashes among them, then end it as they would have without this. Signals that are ignored or caught
/// already stay so. SIGXFSZ is ignored: a file beyond the user's limit is an error of write(), like a full disk.
void clean_up_on_signals(OnRequest on_request);

/// Ends the program at once, from any thread, whatever the others do: removes all files under construction, writes a line
/// to standard error, and leaves with that code.
[[noreturn]] void exit_now(int code, const std::string& line);

/// Names a file that such a signal removes during this object's lifetime: a name in an open folder.
class RemoveOnSignal {
 public:
  static constexpr std::size_t longest_name = 31, max_files = 64;

  /// Takes an open folder and a name. Errors: throws std::length_error on a longer name, or more files at a time.
  RemoveOnSignal(int folder, std::string_view name);
  ~RemoveOnSignal();
  RemoveOnSignal(const RemoveOnSignal&) = delete;
  RemoveOnSignal& operator=(const RemoveOnSignal&) = delete;

 private:
  std::size_t place_;  ///< where handlers search for it
};

}  // namespace bch::cli
