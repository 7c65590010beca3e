// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <atomic>
#include <cstddef>
#include <map>
#include <mutex>
#include <utility>

#include <bch/shapes.hpp>

#include "kernel/runtime/spares.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/floating_point_state.hpp"

namespace bch::detail {

/// Builds shapes 0 .. `count` on all threads, and adds them to a builder in their order, so that the bytes do not depend on threads:
/// prepare(place, i) builds shape i; added(i) is called when it was added, by any thread, one call at a time. The first exception of
/// either ends the work.
template <class Prepare, class Added>
void add_in_order(ShapeSetBuilder& builder, const ShapeSetPlan& plan, std::size_t count,
                  const Prepare& prepare, const Added& added) {
  Spares<BuiltShape> places;
  std::map<std::size_t, typename Spares<BuiltShape>::Loan> waiting;  // for shapes before them
  std::mutex of_waiting;
  std::atomic<std::size_t> next = 0;
  std::size_t in = 0;
  bool is_adding = false;
  const auto prepare_next = [&] {
    // Tasks build the next shape, whatever their ranges are, so that few shapes have to wait.
    const std::size_t i = next.fetch_add(1);
    auto place = places.borrow([&] { return BuiltShape(plan); });
    prepare(*place, i);
    std::unique_lock lock(of_waiting);
    waiting.emplace(i, std::move(place));
    if (std::exchange(is_adding, true)) return;  // the thread that is adding adds this one, too
    while (!waiting.empty() && waiting.begin()->first == in) {
      const auto first = waiting.extract(waiting.begin());
      lock.unlock();
      builder.add(*first.mapped());
      added(first.key());
      lock.lock();
      ++in;
    }
    is_adding = false;
  };
  const FloatingPointStateGuard floats;
  for_ranges(count, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) prepare_next();
  });
}

}  // namespace bch::detail
