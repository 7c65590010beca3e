// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include "tests/support/on_threads.hpp"

namespace bch::test {

void on_threads(std::uint32_t threads, const std::function<void()>& work) {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, threads);
  tbb::task_arena(static_cast<int>(threads)).execute(work);
}

}  // namespace bch::test
