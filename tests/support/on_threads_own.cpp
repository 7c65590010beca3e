// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/runtime/tasks.hpp"
#include "tests/support/on_threads.hpp"

namespace bch::test {

void on_threads(std::uint32_t threads, const std::function<void()>& work) {
  detail::run_on_threads(threads, detail::RangeWork([&](std::size_t, std::size_t) { work(); }));
}

}  // namespace bch::test
