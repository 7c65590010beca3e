// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>

#include "bench/base/median.hpp"
#include "bench/micro/micro.hpp"
#include "bench/workload/answer_checks.hpp"
#include "bench/workload/micro_timing.hpp"

namespace bch::bench {
namespace {

struct Question {
  std::string_view name;
  Semantics semantics;
  Leaves leaves;
};
constexpr Question questions[] = {{"boundary", Semantics::boundary, Leaves::discs},
                                  {"solid", Semantics::solid, Leaves::discs},
                                  {"boundary_segments", Semantics::boundary, Leaves::segments},
                                  {"solid_segments", Semantics::solid, Leaves::segments}};

void count_hits(benchmark::State& state, Scene& scene, const Workload& workload, const Hits& hits) {
  const Hits& meshes = scene.hits("obb_full", workload);
  std::size_t all = 0, false_positives = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    all += hits[i];
    false_positives += hits[i] != 0 && meshes[i] == 0;
  }
  state.counters["hits"] = static_cast<double>(all);
  state.counters["false_positives"] = static_cast<double>(false_positives);
}

void run_kernel(benchmark::State& state, Scene& scene, std::string_view workload_name,
                const QueryOptions& options, int threads) {
  const Workload& workload = scene.workload(workload_name);
  const ShapeSet& set = scene.set();
  Hits hits(workload.pairs.size());
  tbb::task_arena arena(threads);
  const auto query = [&] {
    arena.execute([&] { collide(set, workload.agents(), workload.pairs, hits, options); });
  };
  query();
  if (const auto wrong = wrong_kernel(scene, workload, options, hits); !wrong.empty())
    return state.SkipWithError(wrong.c_str());
  time_calls(state, workload, threads, query);
  count_hits(state, scene, workload, hits);
  state.counters["bytes_per_shape"] = static_cast<double>(set.bytes()) / set.shape_count();
}

void run_structure(benchmark::State& state, Scene& scene, std::string_view workload_name,
                   const baselines::Kind& kind) {
  const Workload& workload = scene.workload(workload_name);
  const baselines::Structure& structure = scene.structure(kind.name);
  Hits hits(workload.pairs.size());
  const auto query = [&] { structure.query(workload.agents(), workload.pairs, hits); };
  query();
  if (const auto wrong = wrong_structure(scene, workload, kind, hits); !wrong.empty())
    return state.SkipWithError(wrong.c_str());
  time_calls(state, workload, 1, query);
  count_hits(state, scene, workload, hits);

  baselines::TestCounts counts;
  for (const Pair pair : workload.pairs) structure.query(workload.agents(), pair, all_depths, counts);
  if (const std::uint64_t tests = counts.nodes + counts.leaves; tests > 0)
    state.counters["tests_per_pair"] =
        static_cast<double>(tests) / static_cast<double>(workload.pairs.size());
  if (counts.ancestors > 0)
    state.counters["ancestor_tests_per_pair"] =
        static_cast<double>(counts.ancestors) / static_cast<double>(workload.pairs.size());
  std::size_t bytes = 0;
  for (std::uint32_t shape = 0; shape < structure.shape_count(); ++shape) bytes += structure.bytes(shape);
  state.counters["bytes_per_shape"] = static_cast<double>(bytes) / structure.shape_count();
}

void register_kernel(Scene& scene, std::string_view workload, const kernel::Implementation& implementation) {
  for (const auto& [name_of_question, semantics, leaves] : questions)
    for (const int threads : thread_counts()) {
      const std::string name = fmt::format("collide/{}/{}/{}/threads:{}", workload, implementation.name,
                                           name_of_question, threads);
      const QueryOptions options{semantics, &implementation, leaves};
      benchmark::RegisterBenchmark(name.c_str(),
                                   [&scene, workload, options, threads](benchmark::State& state) {
                                     run_kernel(state, scene, workload, options, threads);
                                   });
    }
}

void register_structure(Scene& scene, std::string_view workload, const baselines::Kind& kind) {
  const std::string name = fmt::format("collide/{}/{}/boundary/threads:1", workload, kind.name);
  benchmark::RegisterBenchmark(name.c_str(), [&scene, workload, &kind](benchmark::State& state) {
    run_structure(state, scene, workload, kind);
  });
}

}  // namespace

void register_collide_benchmarks(Scene& scene) {
  for (const std::string_view workload : workload_names()) {
    for (const kernel::Implementation& implementation : kernel::implementations())
      if (implementation.supported()) register_kernel(scene, workload, implementation);
    for (const baselines::Kind& kind : baselines::kinds()) register_structure(scene, workload, kind);
  }
}

}  // namespace bch::bench
