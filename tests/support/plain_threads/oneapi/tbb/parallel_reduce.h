// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <oneapi/tbb/task_group.h>

#include "tests/support/plain_threads/plain_threads.hpp"

namespace tbb {

template <class Value, class Body, class Join>
Value parallel_reduce(const blocked_range<std::size_t>& range, const Value& identity, const Body& body,
                      const Join& join, const task_group_context&) {
  std::array<Value, bch::test::plain_threads> parts;
  parts.fill(identity);
  bch::test::on_plain_threads([&](std::size_t t) { parts[t] = body(bch::test::part(range, t), parts[t]); });
  Value all = identity;
  for (const Value& value : parts) all = join(all, value);
  return all;
}

}  // namespace tbb
