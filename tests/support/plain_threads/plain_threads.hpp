// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <oneapi/tbb/blocked_range.h>

#include <array>
#include <cstddef>
#include <thread>
#include <vector>

// ThreadSanitizer takes everything that passes through an uninstrumented TBB for a race. In a build with it this folder
// stands before TBB's headers, and what the kernel gives to TBB runs on these threads, where every access is seen.

namespace bch::test {

constexpr std::size_t plain_threads = 4;

/// Calls work(t) for all t below plain_threads, each on a thread of its own.
template <class Work>
void on_plain_threads(const Work& work) {
  std::vector<std::thread> running;
  for (std::size_t t = 0; t < plain_threads; ++t) running.emplace_back([&work, t] { work(t); });
  for (std::thread& thread : running) thread.join();
}

/// Returns the t-th of the parts that a range is cut into.
inline tbb::blocked_range<std::size_t> part(const tbb::blocked_range<std::size_t>& range, std::size_t t) {
  const std::size_t size = range.end() - range.begin();
  return {range.begin() + size * t / plain_threads, range.begin() + size * (t + 1) / plain_threads};
}

}  // namespace bch::test
