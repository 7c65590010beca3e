// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/runtime/tasks.hpp"

namespace bch::detail {

void run_ranges_by_default(std::size_t count, std::size_t, const RangeWork& work) {
  work(0, count);
}

void run_isolated_by_default(const RangeWork& work) {
  work(0, 0);
}

void run_on_threads_by_default(std::uint32_t, const RangeWork& work) {
  work(0, 0);
}

std::uint32_t task_threads_by_default() {
  return 1;
}

}  // namespace bch::detail
