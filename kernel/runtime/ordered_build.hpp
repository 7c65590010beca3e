// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include <cstddef>
#include <vector>

#include <bch/shapes.hpp>

#include "layout/base/floating_point_state.hpp"

namespace bch::detail {

/// The number of shapes a thread that are being built or wait for one before them: enough that a slow pose does not make the other threads
/// wait, few enough that their memory stays in a near cache (24 of them take 5 % longer).
constexpr std::size_t shapes_in_flight = 4;

/// Adds shapes 0 to `count` to a builder of a plan, in their order, so that the bytes do not depend on the threads that make them:
/// `make(i)` returns shape i, as a reference that is valid until the same thread's next call, and `added(i)` is called when it is in, by any
/// thread, one call at a time. The first exception of either ends the work.
template <class Make, class Added>
void add_in_order(ShapeSetBuilder& builder, const ShapeSetPlan& plan, std::size_t count, Make make,
                  Added added) {
  // Shape i waits in place i % n. They leave in order and no more than n are on their way, so that the place is free
  // again. Indices alone go from stage to stage: the pipeline never destroys what it holds when a stage throws.
  const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  std::vector<PreparedShape> places;
  for (std::size_t i = 0; i < count && i < shapes_in_flight * threads; ++i) places.emplace_back(plan);
  if (places.empty()) return;
  std::size_t next = 0;
  const auto take = [&](tbb::flow_control& flow) -> std::size_t {
    if (next == count) flow.stop();
    return next++;
  };
  const auto build = [&](std::size_t i) -> std::size_t {
    const FloatingPointStateGuard floats;
    places[i % places.size()].prepare(make(i), i);
    return i;
  };
  const auto add = [&](std::size_t i) {
    builder.add(places[i % places.size()]);
    added(i);
  };
  tbb::task_group_context own(tbb::task_group_context::isolated);  // see for_ranges()
  tbb::parallel_pipeline(places.size(),
                         tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, take) &
                             tbb::make_filter<std::size_t, std::size_t>(tbb::filter_mode::parallel, build) &
                             tbb::make_filter<std::size_t, void>(tbb::filter_mode::serial_in_order, add),
                         own);
}

}  // namespace bch::detail
