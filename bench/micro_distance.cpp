// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <functional>

#include "baselines/clearance_reference.hpp"
#include "baselines/contact_time_reference.hpp"
#include "bench/distance_answers.hpp"
#include "bench/micro.hpp"
#include "bench/micro_timing.hpp"

namespace bch::bench {
namespace {

void count_within(benchmark::State& state, const std::vector<float>& answers, float most) {
  state.counters["within"] = static_cast<double>(
      std::count_if(answers.begin(), answers.end(), [most](float value) { return value <= most; }));
}

void time_clearance(benchmark::State& state, Scene& scene, const Workload& workload,
                    const std::function<void(Clearances&)>& query, int threads) {
  Clearances answers(workload.pairs.size());
  query(answers);
  if (const auto wrong = wrong_clearances(scene, workload, answers); !wrong.empty())
    return state.SkipWithError(wrong.c_str());
  time_calls(state, workload, threads, [&] { query(answers); });
  count_within(state, answers.distance, static_cast<float>(clearance_limit));
}

void time_contact(benchmark::State& state, Scene& scene, const Workload& workload,
                  const std::function<void(std::vector<float>&)>& query, int threads) {
  std::vector<float> times(workload.pairs.size());
  query(times);
  if (const auto wrong = wrong_contact_times(scene, workload, times); !wrong.empty())
    return state.SkipWithError(wrong.c_str());
  time_calls(state, workload, threads, [&] { query(times); });
  count_within(state, times, 1);
}

void run_clearance(benchmark::State& state, Scene& scene, std::string_view name,
                   const kernel::Implementation& implementation, int threads) {
  const Workload& workload = scene.workload(name);
  const ShapeSet& set = scene.set(Semantics::boundary);
  tbb::task_arena arena(threads);
  const auto query = [&](Clearances& answers) {
    arena.execute([&] {
      clearance(set, workload.agents(), workload.pairs, answers.spans(), {clearance_limit, &implementation});
    });
  };
  time_clearance(state, scene, workload, query, threads);
}

void run_scalar_clearance(benchmark::State& state, Scene& scene, std::string_view name) {
  const Workload& workload = scene.workload(name);
  baselines::ClearanceReference reference(scene.shapes(), {});
  const auto query = [&](Clearances& answers) {
    for (std::size_t i = 0; i < workload.pairs.size(); ++i) {
      const auto nearest = reference.query(workload.agents(), workload.pairs[i], clearance_limit,
                                           baselines::Method::depth_first);
      answers.distance[i] = nearest.distance, answers.direction[i] = nearest.direction;
    }
  };
  time_clearance(state, scene, workload, query, 1);
}

void run_contact_time(benchmark::State& state, Scene& scene, std::string_view name,
                      const kernel::Implementation& implementation, int threads) {
  const Workload& workload = scene.workload(name);
  const ShapeSet& set = scene.set(Semantics::boundary);
  const Ways ways(workload);
  tbb::task_arena arena(threads);
  const auto query = [&](std::vector<float>& times) {
    arena.execute([&] {
      contact_time(set, workload.agents(), workload.pairs, ways.displacements(), times, {&implementation});
    });
  };
  time_contact(state, scene, workload, query, threads);
}

void run_scalar_contact_time(benchmark::State& state, Scene& scene, std::string_view name) {
  const Workload& workload = scene.workload(name);
  const Ways ways(workload);
  baselines::ContactTimeReference reference(scene.shapes(), {});
  const auto query = [&](std::vector<float>& times) {
    for (std::size_t i = 0; i < workload.pairs.size(); ++i)
      times[i] = reference.query(workload.agents(), workload.pairs[i], ways.x[i], ways.y[i],
                                 baselines::Method::depth_first);
  };
  time_contact(state, scene, workload, query, 1);
}

template <class Run>
void add(std::string_view query, std::string_view workload, std::string_view structure, int threads,
         Run run) {
  const std::string name = fmt::format("{}/{}/{}/threads:{}", query, workload, structure, threads);
  benchmark::RegisterBenchmark(name.c_str(), run);
}

}  // namespace

void register_distance_benchmarks(Scene& scene) {
  for (const std::string_view workload : workload_names()) {
    for (const kernel::Implementation& implementation : kernel::implementations()) {
      if (!implementation.supported()) continue;
      for (const int threads : thread_counts()) {
        add("clearance", workload, implementation.name, threads,
            [&scene, workload, &implementation, threads](benchmark::State& state) {
              run_clearance(state, scene, workload, implementation, threads);
            });
        add("contact_time", workload, implementation.name, threads,
            [&scene, workload, &implementation, threads](benchmark::State& state) {
              run_contact_time(state, scene, workload, implementation, threads);
            });
      }
    }
    add("clearance", workload, "reference", 1,
        [&scene, workload](benchmark::State& state) { run_scalar_clearance(state, scene, workload); });
    add("contact_time", workload, "reference", 1,
        [&scene, workload](benchmark::State& state) { run_scalar_contact_time(state, scene, workload); });
  }
}

}  // namespace bch::bench
