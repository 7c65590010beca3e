// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_reduce.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <algorithm>
#include <cstddef>

#include "layout/base/floating_point_state.hpp"

namespace bch::detail {

/// Calls work(begin, end) for ranges that together are [0, count): as TBB's tasks of `grain` and more, where
/// there is more than one, because a task costs more than a small batch. Tasks run in the standard
/// floating-point state; the caller has to be in it. They are a group of their own: where the caller's is
/// cancelled meanwhile, because another of its tasks threw for instance, TBB would leave out these as well,
/// and return as if they had run.
template <class Work>
void for_ranges(std::size_t count, std::size_t grain, const Work& work) {
  using Range = tbb::blocked_range<std::size_t>;
  if (count <= grain) return work(std::size_t{0}, count);
  tbb::task_group_context own(tbb::task_group_context::isolated);
  tbb::parallel_for(
      Range(0, count, grain),
      [&](const Range& range) {
        const FloatingPointStateGuard floats;
        work(range.begin(), range.end());
      },
      own);
}

/// Calls add(begin, end, value) for ranges as for_ranges() does, and joins their results. A value begins as
/// `identity` and passes from range to range.
template <class Value, class Add, class Join>
Value reduce_ranges(std::size_t count, std::size_t grain, const Value& identity, const Add& add,
                    const Join& join) {
  using Range = tbb::blocked_range<std::size_t>;
  if (count <= grain) return add(std::size_t{0}, count, identity);
  tbb::task_group_context own(tbb::task_group_context::isolated);
  return tbb::parallel_reduce(
      Range(0, count, grain), identity,
      [&](const Range& range, const Value& value) {
        const FloatingPointStateGuard floats;
        return add(range.begin(), range.end(), value);
      },
      join, own);
}

/// Runs work() so that a thread that waits in it takes no task from outside, which might be the next call for
/// the same object.
template <class Work>
decltype(auto) without_tasks_from_outside(const Work& work) {
  return tbb::this_task_arena::isolate(work);
}

/// Calls work(begin, size) for at most `grain` pairs each, in the ranges of for_ranges().
template <class Work>
void for_pair_ranges(std::size_t pairs, std::size_t grain, const Work& work) {
  for_ranges(pairs, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i += grain) work(i, std::min(grain, end - i));
  });
}

}  // namespace bch::detail
