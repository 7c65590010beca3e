// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/runtime/tasks.hpp"

#include <optional>
#include <stdexcept>
#include <string>

#include <bch/query.hpp>

#include "kernel/runtime/executor_tasks.hpp"

namespace bch {

using namespace detail;

namespace {

constexpr std::uint32_t max_threads_of_executor = 1024;

std::optional<Executor> executor_of_caller;

}  // namespace

void Executor::set(const Executor& executor) {
  if (executor.run == nullptr) return executor_of_caller.reset();
  if (executor.threads < 1 || executor.threads > max_threads_of_executor)
    throw std::invalid_argument("executor: expected 1 to " + std::to_string(max_threads_of_executor) +
                                " threads, found " + std::to_string(executor.threads));
  executor_of_caller = executor;
}

namespace detail {

void run_ranges(std::size_t count, std::size_t grain, const RangeWork& work) {
  if (executor_of_caller) return run_ranges_on(*executor_of_caller, count, grain, work);
  run_ranges_by_default(count, grain, work);
}

void run_isolated(const RangeWork& work) {
  if (executor_of_caller) return work(0, 0);
  run_isolated_by_default(work);
}

void run_on_threads(std::uint32_t threads, const RangeWork& work) {
  if (executor_of_caller) return work(0, 0);
  run_on_threads_by_default(threads, work);
}

std::uint32_t task_threads() {
  return executor_of_caller ? executor_of_caller->threads : task_threads_by_default();
}

}  // namespace detail
}  // namespace bch
