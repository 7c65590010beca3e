// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <numeric>
#include <stdexcept>

#include "bench/ratios/counted_kernel.hpp"
#include "bench/ratios/ratios.hpp"
#include "bench/workload/scene.hpp"
#include "kernel/runtime/kernels.hpp"
#include "layout/base/time_stamp.hpp"

namespace bch::bench {
namespace {

using detail::stage_count;

constexpr std::array<const char*, stage_count> stage_names = {"place",       "profiles",    "even_supports",
                                                              "inscribed_4", "inscribed_8", "odd_supports",
                                                              "add",         "blocks",      "leaves"};

double ns_per_tick() {
  const auto begin = std::chrono::steady_clock::now();
  const std::uint64_t first = detail::time_stamp();
  while (std::chrono::steady_clock::now() - begin < std::chrono::milliseconds(20)) {
  }
  const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - begin;
  return time.count() / static_cast<double>(detail::time_stamp() - first);
}

/// Runs a call repeatedly on one thread. Returns: what it counted in the quickest run.
StageCounts quickest(StageCounts& counts, const std::function<void()>& call) {
  constexpr int runs = 100;
  tbb::task_arena one_thread(1);
  StageCounts best;
  std::uint64_t least = ~std::uint64_t{0};
  for (int i = 0; i < runs; ++i) {
    counts = {};
    one_thread.execute(call);
    const std::uint64_t all = std::accumulate(counts.ticks.begin(), counts.ticks.end(), std::uint64_t{0});
    if (all < least) least = all, best = counts;
  }
  return best;
}

/// An implementation of which one kernel is replaced by the counted one.
struct Counted {
  detail::Kernels kernels;
  Implementation implementation;

  Counted(const CountedKernel& kernel, const Implementation& original)
      : kernels(*original.kernels), implementation(original) {
    kernels.run = kernel.run;
    implementation.kernels = &kernels;
  }
};

Contender contender(Scene& scene, std::string_view name, const CountedKernel& kernel,
                    const Implementation& original) {
  const Workload& workload = scene.workload(name);
  const auto counted = std::make_shared<Counted>(kernel, original);
  Contender result = collide_contender(
      scene.set(), workload.agents(), workload.pairs, {&counted->implementation, Leaves::segments},
      [&](const Hits& hits) { return wrong_kernel(scene, workload, Leaves::segments, hits); });
  const StageCounts best = quickest(kernel.counts, result.call);
  const double pairs = static_cast<double>(workload.pairs.size()), ns = ns_per_tick();
  result.counters.clear();
  for (unsigned k = 0; k < stage_count; ++k) {
    result.counters[stage_names[k]] = static_cast<double>(best.ticks[k]) * ns / pairs;
    result.counters[fmt::format("{}.tests", stage_names[k])] = static_cast<double>(best.tests[k]) / pairs;
  }
  result.call = [counted, call = std::move(result.call)] { call(); };
  return result;
}

}  // namespace

void add_stages(Scene& scene) {
  for (const CountedKernel& kernel : {counted_avx2_kernel(), counted_avx512_kernel()})
    for (const Implementation* implementation : supported_implementations()) {
      if (implementation->name != std::string_view(kernel.implementation)) continue;
      for (const std::string_view name : {"crowd", "colliding", "near_miss", "no_hit"})
        add(fmt::format("stages/{}/{}", name, kernel.implementation), [&scene, name, kernel, implementation] {
          return contender(scene, name, kernel, *implementation);
        });
    }
}

}  // namespace bch::bench
