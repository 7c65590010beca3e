// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <algorithm>
#include <memory>

#include "kernel/runtime/tasks.hpp"
#include "layout/base/floating_point_state.hpp"

namespace bch::detail {
namespace {

/// Holds the last arena of a thread. Each thread has its own, so that its calls do not wait for those of others.
struct ArenaOfThread {
  std::uint32_t threads = 0;
  std::unique_ptr<tbb::task_arena> arena;
};
thread_local ArenaOfThread last_arena;

}  // namespace

/// Runs in an isolated task_group_context: otherwise cancellation of the caller's group, because another of its tasks throws for
/// instance, would silently skip tasks.
void run_ranges_by_default(std::size_t count, std::size_t grain, const RangeWork& work) {
  using Range = tbb::blocked_range<std::size_t>;
  tbb::task_group_context own(tbb::task_group_context::isolated);
  tbb::parallel_for(
      Range(0, count, grain),
      [&](const Range& range) {
        const FloatingPointStateGuard floats;
        work(range.begin(), range.end());
      },
      own);
}

void run_isolated_by_default(const RangeWork& work) {
  tbb::this_task_arena::isolate([&] { work(0, 0); });
}

void run_on_threads_by_default(std::uint32_t threads, const RangeWork& work) {
  // TBB would print a warning about more threads than it has.
  threads = std::min(threads, static_cast<std::uint32_t>(tbb::global_control::active_value(
                                  tbb::global_control::max_allowed_parallelism)));
  if (last_arena.threads != threads) {
    last_arena.threads = 0;
    last_arena.arena = std::make_unique<tbb::task_arena>(static_cast<int>(threads));
    last_arena.threads = threads;
  }
  last_arena.arena->execute([&] { work(0, 0); });
}

std::uint32_t task_threads_by_default() {
  return static_cast<std::uint32_t>(tbb::this_task_arena::max_concurrency());
}

}  // namespace bch::detail
