// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "bench/base/median.hpp"
#include "bench/base/stopwatch.hpp"
#include "bench/workload/answer_checks.hpp"
#include "bench/workload/race.hpp"

namespace bch::bench {
namespace {

constexpr double shortest_run = 1e7;  ///< nanoseconds

/// Times a call in an arena of its own size: with one thread, the caller's time is then all of the time that
/// the call takes. Other threads are woken first, which takes about a millisecond and does not happen between
/// the frames of a simulation.
double time_run(const std::function<void()>& call, int threads) {
  tbb::task_arena arena(threads);
  if (threads > 1) arena.execute(call);
  const Stopwatch watch(threads);
  std::uint32_t calls = 0;
  do {
    arena.execute(call);
    ++calls;
  } while (watch.nanoseconds() < shortest_run);
  return watch.nanoseconds() / calls;
}

}  // namespace

void race(std::vector<Contender>& contenders, std::uint32_t runs, int threads) {
  for (Contender& contender : contenders) {
    contender.runs.clear();
    contender.call();  // caches, page faults
  }
  for (std::uint32_t run = 0; run < runs; ++run)
    for (Contender& contender : contenders) contender.runs.push_back(time_run(contender.call, threads));
  for (Contender& contender : contenders) contender.nanoseconds = cli::median(contender.runs);
}

void require_right(const std::string& name, const Workload& workload, const std::string& wrong) {
  if (!wrong.empty()) throw std::runtime_error(fmt::format("{} on {}: {}", name, workload.name, wrong));
}

bool has_kind(std::string_view kind) {
  const auto kinds = baselines::kinds();
  return std::any_of(kinds.begin(), kinds.end(),
                     [&](const baselines::Kind& row) { return row.name == kind; });
}

Contender kernel_contender(Scene& scene, const Workload& workload, const QueryOptions& query,
                           const kernel::Implementation& implementation) {
  const auto hits = std::make_shared<Hits>(workload.pairs.size());
  const auto call = [&set = scene.set(), &workload, hits,
                     options = QueryOptions{query.semantics, &implementation, query.leaves}] {
    collide(set, workload.agents(), workload.pairs, *hits, options);
  };
  call();
  require_right(implementation.name, workload, wrong_kernel(scene, workload, query, *hits));
  return {implementation.name, call};
}

Contender structure_contender(Scene& scene, const Workload& workload, std::string_view kind) {
  const auto hits = std::make_shared<Hits>(workload.pairs.size());
  const auto call = [&structure = scene.structure(kind), &workload, hits] {
    structure.query(workload.agents(), workload.pairs, *hits);
  };
  call();
  require_right(std::string(kind), workload, wrong_structure(scene, workload, baselines::kind(kind), *hits));
  return {std::string(kind), call};
}

}  // namespace bch::bench
