// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <time.h>

#include <cstdint>

namespace bch::bench {

/// Nanoseconds since it was made.
class Stopwatch {
 public:
  /// The calling thread's time forgives other programs that want the processor, but knows nothing of other
  /// threads' work: for one thread the former, for several the wall clock.
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
