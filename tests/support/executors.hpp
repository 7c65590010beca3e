// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <atomic>
#include <thread>

#include <bch/query.hpp>

#include "tests/support/test.hpp"

namespace bch::test {

/// Runs tasks backwards, on the calling thread or on two threads, and counts.
struct CountingExecutor {
  std::atomic<std::size_t> tasks = 0, calls = 0;
  bool on_threads = false;

  static void run(void* context, std::size_t count, void (*task)(void*, std::size_t), void* data) {
    auto& own = *static_cast<CountingExecutor*>(context);
    own.tasks += count, ++own.calls;
    const auto every_other = [=](std::size_t first, std::size_t step) {
      for (std::size_t i = first; i < count; i += step) task(data, count - 1 - i);
    };
    if (!own.on_threads) return every_other(0, 1);
    std::thread other(every_other, 1, 2);
    every_other(0, 2);
    other.join();
  }
  Executor executor() { return {run, this, 3}; }
};

/// Expects that answers() returns the same on what the library was built with, on the calling thread alone and on threads of a caller's
/// own, to which use() switches.
template <class Answers, class Use>
void expect_same_on_each_executor(const Answers& answers, const Use& use) {
  const auto expected = answers();
  for (const bool on_threads : {false, true}) {
    CountingExecutor own{.on_threads = on_threads};
    use(own.executor());
    const auto found = answers();
    use(Executor{});
    EXPECT_TRUE(found == expected) << (on_threads ? "threads of a caller's own" : "the calling thread");
    EXPECT_GT(own.calls, 0u);
    EXPECT_GT(own.tasks, own.calls);
  }
}

}  // namespace bch::test
