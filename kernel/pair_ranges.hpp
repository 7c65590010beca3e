// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

#include "kernel/standard_floats.hpp"

namespace bch::kernel {

/// Calls work(begin, size) for ranges of at most `grain` pairs, which together are all of them: as TBB's tasks, where
/// there is more than one. Each in the standard floating-point state.
template <class Work>
void for_pair_ranges(std::size_t pairs, std::size_t grain, const Work& work) {
  using Range = tbb::blocked_range<std::size_t>;
  const auto run = [&](const Range& range) {
    const StandardFloats floats;
    for (std::size_t i = range.begin(); i < range.end(); i += grain)
      work(i, std::min(grain, range.end() - i));
  };
  const Range all(0, pairs, grain);
  pairs <= grain ? run(all) : tbb::parallel_for(all, run);
}

}  // namespace bch::kernel
