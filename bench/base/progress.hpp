// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

namespace bch::cli {

/// Shows a progress bar on standard error for work of more than a second, with the rate and the time left at
/// that rate. It is shown on a terminal only, and removed when the work ends.
class Progress {
 public:
  Progress(std::string what, std::size_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Shows the bar already now: for few steps, of which the first may take long.
  void show();

  /// Counts one more of the total as done. May be called from any thread.
  void advance();

 private:
  void draw(std::size_t done);

  using Clock = std::chrono::steady_clock;
  std::string what_;
  std::size_t total_;
  bool terminal_;
  bool drawn_ = false;
  Clock::time_point begin_ = Clock::now(), next_;
  std::atomic<std::size_t> done_{0};
  std::mutex drawing_;
};

}  // namespace bch::cli
