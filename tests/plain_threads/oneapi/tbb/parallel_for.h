// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "tests/plain_threads/plain_threads.hpp"

namespace tbb {

template <class Body>
void parallel_for(const blocked_range<std::size_t>& range, const Body& body) {
  bch::test::on_plain_threads([&](std::size_t t) { body(bch::test::part(range, t)); });
}

template <class Body>
void parallel_for(std::size_t first, std::size_t last, const Body& body) {
  parallel_for(blocked_range<std::size_t>(first, last), [&](const blocked_range<std::size_t>& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) body(i);
  });
}

}  // namespace tbb
