// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <oneapi/tbb/task_group.h>

#include "tests/support/plain_threads/plain_threads.hpp"

namespace tbb {

template <class Body>
void parallel_for(const blocked_range<std::size_t>& range, const Body& body, const task_group_context&) {
  bch::test::on_plain_threads([&](std::size_t t) { body(bch::test::part(range, t)); });
}

}  // namespace tbb
