// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/query.hpp>

#include "bench/base/options.hpp"
#include "kernel/runtime/tasks.hpp"

namespace bch::cli {
namespace {

/// Runs tasks on so many of the library's own threads.
void run_tasks(void* threads, std::size_t tasks, void (*task)(void*, std::size_t), void* data) {
  const auto run_range = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) task(data, i);
  };
  const auto run_all = [&](std::size_t, std::size_t) {
    detail::run_ranges_by_default(tasks, 1, detail::RangeWork(run_range));
  };
  detail::run_on_threads_by_default(*static_cast<const unsigned*>(threads), detail::RangeWork(run_all));
}

}  // namespace

Threads::Threads(std::uint32_t wanted) : count(wanted == 0 ? detail::task_threads_by_default() : wanted) {
  const auto kept = std::make_shared<unsigned>(count);
  Executor::set({run_tasks, kept.get(), count});
  limit_ = {kept.get(), [kept](const void*) { Executor::set({}); }};
}

}  // namespace bch::cli
