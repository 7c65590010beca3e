// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <optional>
#include <type_traits>

#include "kernel/runtime/tasks.hpp"

namespace bch::detail {

/// Calls work(begin, end) for ranges that together are [0, count), of at least `grain` each: in tasks, or directly if there is only
/// one. Tasks run in the standard floating-point state; the caller has to be in it.
template <class Work>
void for_ranges(std::size_t count, std::size_t grain, const Work& work) {
  if (count <= grain) return work(std::size_t{0}, count);
  run_ranges(count, grain, RangeWork(work));
}

/// Calls value = add(begin, end, value) for ranges as for_ranges() does, and joins their results. A range begins with `identity` or
/// with what other ranges have joined, so join() has to be commutative, associative and idempotent.
template <class Value, class Add, class Join>
Value reduce_ranges(std::size_t count, std::size_t grain, const Value& identity, const Add& add,
                    const Join& join) {
  Value all = identity;
  std::mutex of_all;
  const auto add_range = [&](std::size_t begin, std::size_t end) {
    const auto locked = [&](const auto& use) {
      const std::lock_guard lock(of_all);
      return use();
    };
    const Value before = locked([&] { return all; });
    const Value added = add(begin, end, before);
    locked([&] { return all = join(all, added); });
  };
  for_ranges(count, grain, add_range);
  return all;
}

/// Runs work() so that a thread that waits in it runs no task from outside, such as another call for the same object.
template <class Work>
auto without_tasks_from_outside(const Work& work) {
  using Result = decltype(work());
  if constexpr (std::is_void_v<Result>) {
    const auto run = [&](std::size_t, std::size_t) { work(); };
    run_isolated(RangeWork(run));
  } else {
    std::optional<Result> result;
    const auto run = [&](std::size_t, std::size_t) { result.emplace(work()); };
    run_isolated(RangeWork(run));
    return *std::move(result);
  }
}

/// Calls work(begin, size) with size <= grain, for all pairs, in the tasks of for_ranges().
template <class Work>
void for_pair_ranges(std::size_t pairs, std::size_t grain, const Work& work) {
  for_ranges(pairs, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i += grain) work(i, std::min(grain, end - i));
  });
}

}  // namespace bch::detail
