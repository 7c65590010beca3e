// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "kernel/collide/pair_kernel.hpp"
#include "kernel/simd/stage.hpp"
#include "layout/base/time_stamp.hpp"

namespace bch::bench {

/// Holds the ticks of the time-stamp counter that stages took, and how many tests they made.
struct StageCounts {
  std::array<std::uint64_t, detail::stage_count> ticks{}, tests{};
};

/// Represents the pair kernel of an instruction set, compiled to be measured.
struct CountedKernel {
  const char* implementation;  ///< name
  void (*run)(const detail::Arguments& arguments, std::size_t begin, std::size_t end) noexcept;
  StageCounts& counts;
};
CountedKernel counted_avx2_kernel();
CountedKernel counted_avx512_kernel();

/// Adds end_stage() to the lanes of an instruction set. Two readings of the counter take about 10 ns, for up to 256 pairs.
template <class Lanes>
struct CountedLanes : Lanes {
  static inline StageCounts counts;

  static void run(const detail::Arguments& arguments, std::size_t begin, std::size_t end) noexcept {
    last_ = detail::time_stamp();
    detail::PairKernel<CountedLanes>::run(arguments, begin, end);
  }
  static void end_stage(detail::Stage stage, std::uint32_t tests) noexcept {
    const std::uint64_t now = detail::time_stamp();
    const auto index = static_cast<std::size_t>(stage);
    counts.ticks[index] += now - last_;
    counts.tests[index] += tests;
    last_ = now;
  }

 private:
  static inline std::uint64_t last_ = 0;
};

}  // namespace bch::bench
