// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <span>
#include <string>
#include <thread>

#include "bench/base/cost_limits.hpp"
#include "bench/characters/characters.hpp"

namespace bch::cli {

/// Watches the time and the memory that building and writing shapes takes, during its lifetime. Beyond a
/// limit it ends the program at once, whatever the program is doing: with a line on standard error,
/// exit_bad_input and no half-written file.
class CostGuard {
 public:
  CostGuard(const CostLimits& limits, std::span<const LoadedCharacter> characters, std::size_t shapes);
  ~CostGuard();
  CostGuard(const CostGuard&) = delete;
  CostGuard& operator=(const CostGuard&) = delete;

 private:
  void watch();

  std::string files_;
  double seconds_, memory_;  ///< the latter in GiB
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  bool is_over_ = false;
  std::mutex mutex_;
  std::condition_variable over_;
  std::thread watcher_;
};

}  // namespace bch::cli
