// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>

#include "bench/report/experiment.hpp"
#include "bench/report/subject.hpp"
#include "bench/report/tree_size.hpp"
#include "bench/report/words.hpp"
#include "bench/workload/answer_checks.hpp"
#include "bench/workload/contender.hpp"

// Query time: figure 3, right, of the paper.

namespace bch::report {
namespace {

/// What the paper timed, nanoseconds.
struct PaperTime {
  std::string_view structure;
  double nanoseconds;
};
constexpr PaperTime paper_times[] = {{"BCH outline", 2660}, {"OBB outline", 4630}, {"OBB projected", 20660}};

double paper_time(std::string_view structure) {
  for (const PaperTime& one : paper_times)
    if (one.structure == structure) return one.nanoseconds;
  return std::numeric_limits<double>::quiet_NaN();
}

constexpr std::string_view paper_workload = "paper500";
constexpr std::string_view workloads[] = {paper_workload, "paper500_cached", "colliding", "near_miss"};

/// Against brute force, disc by disc.
void require_right(Run& run, const Subject& kernel, const QueryOptions& query,
                   const bench::Workload& workload, int threads = 1) {
  bench::Hits hits;
  tbb::task_arena(threads).execute([&] { hits = answers(kernel, workload); });
  bench::require_right(std::string(kernel_name), workload,
                       bench::wrong_kernel(run.scene(), workload, query, hits));
}

Table time_structures(Run& run) {
  Table table({"structure", "pairs", "paper (ns/pair)", "ns/pair", "lower quartile (ns)",
               "upper quartile (ns)", "hits (%)", "nodes a shape", "height", "node tests a pair",
               "leaf tests a pair"});
  std::vector<std::string> names;
  std::vector<Subject> subjects;
  std::vector<TreeSize> sizes(2);
  const auto leaf_discs =
      baselines::kind("bch_projected").build(run.scene().bodies(), {.projected_triangles = false});
  const ShapeSet& set = run.scene().set();
  names = {std::string(kernel_name), std::string(exact_leaves_name)};
  subjects = {subject_of(set), subject_of(set, {})};
  for (const Contestant& contestant : contestants()) {
    names.emplace_back(contestant.name);
    subjects.push_back(subject_of(run.contestants().structure(contestant)));
    sizes.push_back(tree_size(contestant, run.scene().bodies()));
    if (contestant.kind != "bch_projected") continue;
    names.emplace_back(leaf_discs_name);
    subjects.push_back(subject_of(*leaf_discs));
    sizes.push_back(sizes.back());
  }
  double done = 0;
  for (const std::string_view name : workloads) {
    const bench::Workload& workload = run.scene().workload(name);
    require_right(run, subjects[0], bench::disc_query, workload);
    require_right(run, subjects[1], {}, workload);
    for (const Contestant& contestant : contestants()) run.contestants().require_right(contestant, workload);
    const std::vector<Quartiles> taken = times(subjects, workload, run.sizes().runs);
    for (std::size_t i = 0; i < subjects.size(); ++i) {
      const double hits = 100 * static_cast<double>(count_hits(subjects[i], workload)) /
                          static_cast<double>(workload.pairs.size());
      const MeanTests tests = subjects[i].tests(workload);
      table.add({names[i], name, name == paper_workload ? Cell(paper_time(names[i])) : Cell(""),
                 taken[i].median, taken[i].low, taken[i].high, hits, sizes[i].nodes, sizes[i].height,
                 tests.nodes, tests.leaves});
    }
    run.done(0.15 * ++done);
  }
  return table;
}

/// Every instruction set, by one thread and by two where there are two.
Table time_kernels(Run& run) {
  Table table({"instruction set", "semantics", "leaves", "pairs", "threads", "ns/pair", "lower quartile (ns)",
               "upper quartile (ns)"});
  std::vector<int> threads = {1};
  if (tbb::info::default_concurrency() > 1) threads.push_back(std::min(tbb::info::default_concurrency(), 2));
  constexpr QueryOptions queries[] = {{Semantics::boundary, nullptr, Leaves::discs},
                                      {Semantics::solid, nullptr, Leaves::discs},
                                      {Semantics::boundary, nullptr, Leaves::segments},
                                      {Semantics::solid, nullptr, Leaves::segments}};
  for (QueryOptions query : queries)
    for (const std::string_view name : {"colliding", "near_miss", "crowd"})
      for (const int count : threads) {
        const bench::Workload& workload = run.scene().workload(name);
        std::vector<std::string> names;
        std::vector<Subject> subjects;
        for (const Implementation& one : implementations()) {
          if (!one.supported()) continue;
          names.emplace_back(one.name);
          query.implementation = &one;
          subjects.push_back(subject_of(run.scene().set(), query));
          require_right(run, subjects.back(), query, workload, count);
        }
        const std::vector<Quartiles> taken = times(subjects, workload, run.sizes().runs, count);
        for (std::size_t i = 0; i < subjects.size(); ++i)
          table.add({names[i], bench::name_of(query.semantics), bench::name_of(query.leaves), name, count,
                     taken[i].median, taken[i].low, taken[i].high});
      }
  return table;
}

void run_query_time(Run& run) {
  run.write("query_time", time_structures(run));
  run.write("query_time_kernel", time_kernels(run));
}

/// By how many per cent a case is faster that is repeated before the next.
std::string faster_repeated(const Results& results, std::string_view structure) {
  const auto time = [&](std::string_view pairs) {
    return results("query_time").number({{"structure", structure}, {"pairs", pairs}}, "ns/pair");
  };
  return brief(100 * (time(paper_workload) / time("paper500_cached") - 1));
}

}  // namespace

const Experiment query_time_experiment{"query_time", "Query time",   110,
                                       false,        run_query_time, {{"faster repeated", faster_repeated}}};

}  // namespace bch::report
