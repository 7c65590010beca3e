// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

#include "kernel/standard_floats.hpp"

namespace bch::kernel {

/// Calls work(begin, end) for ranges that together are [0, count): as TBB's tasks of `grain` and more, where there is more
/// than one, because a task costs more than a small batch. Tasks run in the standard floating-point state; the caller
/// has to be in it.
template <class Work>
void for_ranges(std::size_t count, std::size_t grain, const Work& work) {
  using Range = tbb::blocked_range<std::size_t>;
  if (count <= grain) return work(std::size_t{0}, count);
  tbb::parallel_for(Range(0, count, grain), [&](const Range& range) {
    const StandardFloats floats;
    work(range.begin(), range.end());
  });
}

/// The same by calls of work(begin, size) for at most `grain` pairs each.
template <class Work>
void for_pair_ranges(std::size_t pairs, std::size_t grain, const Work& work) {
  for_ranges(pairs, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i += grain) work(i, std::min(grain, end - i));
  });
}

}  // namespace bch::kernel
