// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/report/subject.hpp"

#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <stdexcept>

#include "bench/base/stopwatch.hpp"
#include "bench/base/text.hpp"

namespace bch::report {
namespace {

constexpr std::size_t counted_pairs = 2'000;
constexpr double shortest_run = 1e7;  ///< nanoseconds

MeanTests mean_tests(const baselines::Structure& structure, const bench::Workload& workload,
                     std::uint32_t max_depth) {
  baselines::TestCounts counts;
  const std::size_t pairs = std::min(counted_pairs, workload.pairs.size());
  for (std::size_t i = 0; i < pairs; ++i)
    structure.query(workload.agents(), workload.pairs[i], max_depth, counts);
  const auto each = [&](std::uint64_t tests) {
    return static_cast<double>(tests) / static_cast<double>(pairs);
  };
  return {each(counts.nodes), each(counts.leaves)};
}

/// Times a call in an arena of its own size: with one thread, the caller's time is then all of the time that
/// the call takes. Other threads are woken first, which takes about a millisecond and does not happen between
/// the frames of a simulation.
double time_run(const std::function<void()>& call, int threads) {
  tbb::task_arena arena(threads);
  if (threads > 1) arena.execute(call);
  const bench::Stopwatch watch(threads);
  std::uint32_t calls = 0;
  do {
    arena.execute(call);
    ++calls;
  } while (watch.nanoseconds() < shortest_run);
  return watch.nanoseconds() / calls;
}

}  // namespace

std::string slabs_name(std::uint32_t slabs, Leaves leaves) {
  return fmt::format("BCH in {} slabs{}", slabs, leaves == Leaves::discs ? " with discs" : "");
}

std::string cut_name(std::uint32_t depth) {
  return depth == 0 ? "single cylinder" : "BCH outline to depth " + cli::depth_name(depth);
}

Subject subject_of(const baselines::Structure& structure, std::uint32_t max_depth) {
  return {[&structure, max_depth](const bench::Workload& workload, bench::Hits& hits) {
            structure.query(workload.agents(), workload.pairs, hits, max_depth);
          },
          [&structure, max_depth](const SlideCases& cases) { return cases.contacts(structure, max_depth); },
          [&structure, max_depth](const bench::Workload& workload) {
            return mean_tests(structure, workload, max_depth);
          }};
}

Subject subject_of(const ShapeSet& set, const QueryOptions& query) {
  return {[&set, query](const bench::Workload& workload, bench::Hits& hits) {
            collide(set, workload.agents(), workload.pairs, hits, query);
          },
          [&set, leaves = query.leaves](const SlideCases& cases) { return cases.contacts(set, leaves); },
          [](const bench::Workload&) { return MeanTests{}; }};
}

bench::Hits answers(const Subject& subject, const bench::Workload& workload) {
  bench::Hits hits(workload.pairs.size());
  subject.answer(workload, hits);
  return hits;
}

std::size_t count_hits(const Subject& subject, const bench::Workload& workload) {
  const bench::Hits hits = answers(subject, workload);
  return static_cast<std::size_t>(std::count(hits.begin(), hits.end(), 1));
}

std::vector<Quartiles> times(std::span<const Subject> subjects, const bench::Workload& workload,
                             std::uint32_t runs, int threads) {
  bench::Hits hits(workload.pairs.size());
  std::vector<std::vector<double>> taken(subjects.size());
  for (const Subject& subject : subjects) subject.answer(workload, hits);  // caches, page faults
  for (std::uint32_t run = 0; run < runs; ++run)
    for (std::size_t i = 0; i < subjects.size(); ++i)
      taken[i].push_back(time_run([&] { subjects[i].answer(workload, hits); }, threads) /
                         static_cast<double>(workload.pairs.size()));
  std::vector<Quartiles> of_pairs;
  for (const std::vector<double>& times : taken) of_pairs.push_back(quartiles(times));
  return of_pairs;
}

void require_same(const Subject& a, const Subject& b, const bench::Workload& workload) {
  if (answers(a, workload) != answers(b, workload))
    throw std::logic_error(workload.name + ": two answers to the same question differ");
}

}  // namespace bch::report
