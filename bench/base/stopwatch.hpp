// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <time.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace bch::bench {

/// Returns the median; of an even number of values, the greater of the two in the middle.
/// Precondition: not empty.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Measures nanoseconds since its construction.
class Stopwatch {
 public:
  /// Chooses the clock: the calling thread's time for one thread, the wall clock for several. The former does
  /// not count the time of other programs on the processor, but misses the work of other threads.
  explicit Stopwatch(int threads) : clock_(threads == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC) {}

  double nanoseconds() const { return static_cast<double>(now() - begin_); }

 private:
  std::int64_t now() const {
    timespec time;
    clock_gettime(clock_, &time);
    return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
  }

  clockid_t clock_;
  std::int64_t begin_ = now();
};

}  // namespace bch::bench
