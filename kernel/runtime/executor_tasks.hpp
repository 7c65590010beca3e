// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>

#include <bch/query.hpp>

#include "kernel/runtime/tasks.hpp"
#include "layout/base/floating_point_state.hpp"

namespace bch::detail {

/// Divides a call of run_ranges() into tasks, one range each.
class ExecutorTasks {
 public:
  ExecutorTasks(std::size_t count, std::size_t tasks, const RangeWork& work)
      : count_(count), tasks_(tasks), work_(work) {}

  std::size_t tasks() const { return tasks_; }
  /// Runs a task. Stores the first exception of any task; tasks after that do nothing.
  void run(std::size_t i) noexcept {
    if (has_failed_.load(std::memory_order_relaxed)) return;
    try {
      const FloatingPointStateGuard floats;
      work_(begin(i), begin(i + 1));
    } catch (...) {
      if (!has_failed_.exchange(true)) error_ = std::current_exception();
    }
  }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::size_t begin(std::size_t i) const { return count_ / tasks_ * i + count_ % tasks_ * i / tasks_; }

  std::size_t count_, tasks_;
  const RangeWork& work_;
  std::atomic<bool> has_failed_ = false;
  std::exception_ptr error_;
};

/// Implements run_ranges() by an executor.
inline void run_ranges_on(const Executor& executor, std::size_t count, std::size_t grain,
                          const RangeWork& work) {
  constexpr std::size_t tasks_of_a_thread = 8;  // because their work differs
  const std::size_t most = (count + grain - 1) / grain;
  ExecutorTasks tasks(count, std::min(most, tasks_of_a_thread * executor.threads), work);
  executor.run(
      executor.context, tasks.tasks(),
      [](void* of, std::size_t i) { static_cast<ExecutorTasks*>(of)->run(i); }, &tasks);
  tasks.rethrow();
}

}  // namespace bch::detail
