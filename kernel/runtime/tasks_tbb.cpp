// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include "kernel/runtime/tasks.hpp"
#include "layout/base/floating_point_state.hpp"

namespace bch::detail {

/// Tasks are a group of their own: where the caller's is cancelled meanwhile, because another of its tasks threw for instance, TBB would
/// leave out these as well, and return as if they had run.
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

}  // namespace bch::detail
