// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <system_error>
#include <thread>
#include <utility>

namespace bch::detail {

/// Reports progress to a caller, on the caller's thread and at most twenty times a second. Any thread counts parts.
class ProgressReport {
 public:
  using Function = std::function<bool(std::size_t done, std::size_t total)>;

  /// Takes a function that returns whether the work goes on; an empty one is never called.
  ProgressReport(Function report, std::size_t total) : report_(std::move(report)), total_(total) {}

  /// Counts a finished part.
  /// Errors:  throws std::system_error of operation_canceled if the caller cancels.
  void part_done() {
    const std::size_t done = ++done_;
    if (!report_ || std::this_thread::get_id() != caller_) return;
    const auto now = Clock::now();
    if (now < next_) return;
    next_ = now + std::chrono::milliseconds(50);
    report(done);
  }

  /// Reports that all parts are finished, with the same errors.
  void all_done() {
    if (report_) report(total_);
  }

 private:
  using Clock = std::chrono::steady_clock;

  void report(std::size_t done) {
    if (!report_(done, total_))
      throw std::system_error(std::make_error_code(std::errc::operation_canceled), "cancelled by the caller");
  }

  const Function report_;
  const std::size_t total_;
  const std::thread::id caller_ = std::this_thread::get_id();
  Clock::time_point next_{};
  std::atomic<std::size_t> done_{0};
};

}  // namespace bch::detail
