// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

// What runs the tasks of queries: the caller's Executor, or else what BCH_TASKS names: TBB (tasks_tbb.cpp), threads of our own
// (tasks_threads.cpp), or the calling thread alone (tasks_none.cpp). No other file of the library names any of these.

namespace bch::detail {

/// Refers to a function object of a caller who waits for it, which gets the begin and the end of a range.
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

/// Calls the work, as tasks, for ranges of about `grain` and more that together are [0, count), in the standard floating-point state. Throws
/// what the first task throws that does so; others may be left out then.
void run_ranges(std::size_t count, std::size_t grain, const RangeWork& work);
/// Calls the work, as run_ranges() does, for each number below `count`.
template <class Work>
void run_each(std::size_t count, const Work& work) {
  run_ranges(count, 1, RangeWork([&](std::size_t begin, std::size_t end) {
               for (std::size_t i = begin; i < end; ++i) work(i);
             }));
}
/// Calls work(0, 0) so that this thread takes no task from outside while it waits for those of the work.
void run_isolated(const RangeWork& work);
/// Calls work(0, 0) so that what this thread runs meanwhile has at most `threads` threads; an Executor of the caller has as many as it has.
void run_on_threads(std::uint32_t threads, const RangeWork& work);
/// Returns how many tasks run at once, at most.
std::uint32_t task_threads();

// The same by what BCH_TASKS names.
void run_ranges_by_default(std::size_t count, std::size_t grain, const RangeWork& work);
void run_isolated_by_default(const RangeWork& work);
void run_on_threads_by_default(std::uint32_t threads, const RangeWork& work);
std::uint32_t task_threads_by_default();

}  // namespace bch::detail
