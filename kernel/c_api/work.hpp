// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <thread>

#include "kernel/c_api/arguments.hpp"

namespace bch::c_api {

/// Describes work of many parts: its threads, and what the caller hears of it.
class Work {
 public:
  Work(const bch_work* given, std::size_t total)
      : work_(sized<bch_work>(given, BCH_WORK_INIT, "work")), total_(total) {}

  std::uint32_t threads() const { return work_.threads; }

  /// Counts a part that is ready. Calls the caller back on his own thread, twenty times a second at most.
  /// Errors:  throws Failure where he cancels.
  void part_done() {
    const std::size_t done = ++done_;
    if (work_.progress == nullptr || std::this_thread::get_id() != caller_) return;
    const auto now = Clock::now();
    if (now < next_) return;
    next_ = now + std::chrono::milliseconds(50);
    report(done);
  }

  /// Tells the caller that all is ready.
  void all_done() {
    if (work_.progress != nullptr) report(total_);
  }

 private:
  using Clock = std::chrono::steady_clock;

  void report(std::size_t done) {
    if (work_.progress(work_.user, done, total_) != 0)
      throw Failure(BCH_CANCELLED, "cancelled by the caller");
  }

  const bch_work work_;
  const std::size_t total_;
  const std::thread::id caller_ = std::this_thread::get_id();
  Clock::time_point next_{};
  std::atomic<std::size_t> done_{0};
};

}  // namespace bch::c_api
