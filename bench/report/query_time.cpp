// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/report/subjects.hpp"
#include "bench/workload/answer_checks.hpp"
#include "bench/workload/contender.hpp"

// Query time: figure 3, right, of the paper.

namespace bch::report {
namespace {

constexpr std::string_view paper_workloads[] = {"paper500", "paper500_cached", "colliding", "near_miss"};

/// Against brute force, disc by disc.
void require_right(Run& run, const Subject& kernel, const QueryOptions& query,
                   const bench::Workload& workload) {
  bench::require_right(kernel_name, workload,
                       bench::wrong_kernel(run.scene, workload, query.leaves, answers(kernel, workload)));
}

}  // namespace

void run_query_time(Run& run) {
  const auto& bodies = run.scene.bodies();
  const auto leaf_discs = baselines::kind("bch_projected").build(bodies, {.projected_triangles = false});
  std::vector<Subject> subjects = {subject_of(kernel_name, run.scene.set()),
                                   subject_of(exact_leaves_name, run.scene.set(), {})};
  Structures structures(run.scene);
  for (const Contestant& contestant : contestants()) {
    subjects.push_back(subject_of(contestant.name, structures.of(contestant)));
    const TreeSize size = subjects.back().size = tree_size(contestant, bodies);
    if (contestant.kind != "bch_projected") continue;
    subjects.push_back(subject_of("BCH projected leaf discs", *leaf_discs));
    subjects.back().size = size;
  }
  SubjectTables tables(run);
  tables.add(subjects);
  for (const std::string_view name : paper_workloads) {
    const bench::Workload& workload = run.scene.workload(name);
    require_right(run, subjects[0], bench::disc_query, workload);
    require_right(run, subjects[1], {}, workload);
    for (const Contestant& contestant : contestants()) structures.require_right(contestant, workload);
    tables.time_pairs(workload);
  }
  tables.write("query_time");
}

}  // namespace bch::report
