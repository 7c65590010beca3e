// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

// What runs the tasks of queries: the caller's Executor, or else what BCH_TASKS selects: TBB (tasks_tbb.cpp), our own thread pool
// (tasks_threads.cpp), or the calling thread alone (tasks_none.cpp). No other file of the library uses any of these.

namespace bch::detail {

/// Refers to a function object that is called with the begin and the end of a range, and outlives the call.
class RangeWork {
 public:
  template <class Work>
  explicit RangeWork(const Work& work)
      : work_(&work), call_([](const void* of, std::size_t begin, std::size_t end) {
          (*static_cast<const Work*>(of))(begin, end);
        }) {}
  void operator()(std::size_t begin, std::size_t end) const { call_(work_, begin, end); }

 private:
  const void* work_;
  void (*call_)(const void*, std::size_t, std::size_t);
};

/// Calls the work, as tasks, for ranges of about `grain` and more that together are [0, count), in the standard floating-point state.
/// Rethrows the first exception of a task; other tasks may be skipped then.
void run_ranges(std::size_t count, std::size_t grain, const RangeWork& work);
/// Calls the work, as run_ranges() does, for each number below `count`.
template <class Work>
void run_each(std::size_t count, const Work& work) {
  run_ranges(count, 1, RangeWork([&](std::size_t begin, std::size_t end) {
               for (std::size_t i = begin; i < end; ++i) work(i);
             }));
}
/// Calls work(0, 0) so that this thread runs no task from outside while it waits for those of the work.
void run_isolated(const RangeWork& work);
/// Calls work(0, 0) so that its tasks run on at most `threads` threads. An Executor ignores `threads`.
void run_on_threads(std::uint32_t threads, const RangeWork& work);
/// Returns the largest number of tasks that run at once.
std::uint32_t task_threads();

// The same by what BCH_TASKS selects.
void run_ranges_by_default(std::size_t count, std::size_t grain, const RangeWork& work);
void run_isolated_by_default(const RangeWork& work);
void run_on_threads_by_default(std::uint32_t threads, const RangeWork& work);
std::uint32_t task_threads_by_default();

}  // namespace bch::detail
