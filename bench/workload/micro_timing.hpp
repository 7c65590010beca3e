// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <benchmark/benchmark.h>
#include <oneapi/tbb/info.h>

#include <vector>

#include "bench/base/median.hpp"
#include "bench/base/stopwatch.hpp"
#include "bench/workload/workload.hpp"

namespace bch::bench {

/// Times calls of `query`, each answering all pairs. The median over calls forgives what other programs do
/// to some of them; Google Benchmark's own mean stands beside it.
template <class Query>
void time_calls(benchmark::State& state, const Workload& workload, int threads, Query query) {
  std::vector<double> nanoseconds;
  for ([[maybe_unused]] auto _ : state) {
    const Stopwatch watch(threads);
    query();
    benchmark::ClobberMemory();
    nanoseconds.push_back(watch.nanoseconds());
  }
  const auto pairs = static_cast<double>(workload.pairs.size());
  if (!nanoseconds.empty()) state.counters["ns_per_pair"] = cli::median(nanoseconds) / pairs;
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(workload.pairs.size()));
}

/// Returns powers of two, and the number of all threads of the machine.
inline std::vector<int> thread_counts() {
  const int most = tbb::info::default_concurrency();
  std::vector<int> counts;
  for (int n = 1; n < most; n *= 2) counts.push_back(n);
  counts.push_back(most);
  return counts;
}

}  // namespace bch::bench
