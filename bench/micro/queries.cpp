// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>

#include <functional>
#include <stdexcept>

#include "bench/micro/micro.hpp"
#include "bench/workload/distance_contenders.hpp"
#include "bench/workload/micro_timing.hpp"
#include "bench/workload/response_contenders.hpp"

namespace bch::bench {
namespace {

/// Makes a contender, which compares its answers, and times it.
void time_contender(benchmark::State& state, const Workload& workload, int threads,
                    const std::function<Contender()>& make) {
  try {
    const Contender contender = make();
    tbb::task_arena arena(threads);
    time_calls(state, workload, threads, [&] { arena.execute(contender.call); });
  } catch (const std::runtime_error& wrong) {
    state.SkipWithError(wrong.what());
  }
}

void add(Scene& scene, const TimedQuery& query, std::string_view workload) {
  const auto name = [&](std::string_view structure, int threads) {
    return fmt::format("{}/{}/{}/threads:{}", query.name, workload, structure, threads);
  };
  for (const kernel::Implementation& implementation : kernel::implementations())
    for (const int threads : thread_counts())
      if (implementation.supported())
        benchmark::RegisterBenchmark(
            name(implementation.name, threads).c_str(),
            [&scene, &query, workload, &implementation, threads](benchmark::State& state) {
              const Workload& asked = scene.workload(workload);
              time_contender(state, asked, threads,
                             [&] { return query.kernel(scene, asked, implementation); });
            });
  if (query.reference == nullptr) return;
  benchmark::RegisterBenchmark(
      name("reference", 1).c_str(), [&scene, &query, workload](benchmark::State& state) {
        const Workload& asked = scene.workload(workload);
        time_contender(state, asked, 1, [&] { return query.reference(scene, asked); });
      });
}

}  // namespace

void register_distance_benchmarks(Scene& scene) {
  for (const std::string_view workload : workload_names())
    for (const TimedQuery* query : {&clearance_query(), &time_of_impact_query()})
      add(scene, *query, workload);
}

void register_response_benchmarks(Scene& scene) {
  for (const TimedQuery& query : response_queries())
    for (const std::string_view workload : {"colliding", "crowd"})
      // Agents of pairs of their own stand anywhere, also in each other.
      if (workload == "crowd" || query.reference != nullptr) add(scene, query, workload);
}

}  // namespace bch::bench
