// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/report/subject.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace bch::report {
namespace {

constexpr std::size_t counted_pairs = 2'000;

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

}  // namespace

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
  std::vector<bench::Contender> contenders;
  for (const Subject& subject : subjects)
    contenders.push_back({workload.name, [&] { subject.answer(workload, hits); }});
  bench::race(contenders, runs, threads);
  std::vector<Quartiles> of_pairs;
  const auto pairs = static_cast<double>(workload.pairs.size());
  for (const bench::Contender& contender : contenders) {
    const Quartiles call = quartiles(contender.runs);
    of_pairs.push_back({call.low / pairs, call.median / pairs, call.high / pairs});
  }
  return of_pairs;
}

void require_same(const Subject& a, const Subject& b, const bench::Workload& workload) {
  if (answers(a, workload) != answers(b, workload))
    throw std::logic_error(workload.name + ": two answers to the same question differ");
}

}  // namespace bch::report
