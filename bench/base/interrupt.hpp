// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace bch::cli {

/// Makes every signal that ends the program, and can be caught, remove the file under construction first.
/// SIGINT, SIGTERM and SIGHUP then end it with a message and exit code 128 + signal; all others, crashes among them, as
/// they would have without this. Signals that are ignored or caught already stay so. SIGXFSZ is ignored: a file
/// beyond the user's limit is an error of write(), like a full disk.
void clean_up_on_signals();

/// Ends the program at once, from any thread, whatever the others do: removes the file under construction, writes a line
/// to standard error, and leaves with that code.
[[noreturn]] void leave_at_once(int code, const std::string& line);

/// Names the file that such a signal removes during this object's lifetime: a name in an open folder. Of
/// several such files, a signal removes the last one.
class RemovedOnSignal {
 public:
  static constexpr std::size_t longest_name = 31;

  /// Takes an open folder and a name. Errors: throws std::length_error on a longer name.
  RemovedOnSignal(int folder, std::string_view name);
  ~RemovedOnSignal();
  RemovedOnSignal(const RemovedOnSignal&) = delete;
  RemovedOnSignal& operator=(const RemovedOnSignal&) = delete;
};

}  // namespace bch::cli
