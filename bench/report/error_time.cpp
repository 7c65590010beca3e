// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <deque>

#include "bench/report/subjects.hpp"
#include "bench/workload/scene.hpp"

// What does each microsecond buy? Every structure and depth as a point.

namespace bch::report {
namespace {

/// What points are asked.
constexpr std::string_view requested_workloads[] = {"crowd", "near_miss", "colliding"};

std::vector<std::uint32_t> depths_of(const Run& run) {
  if (run.sizes().poses < full_sizes.poses) return {0, 3, 6, 9, all_depths};
  return {0, 2, 3, 4, 5, 6, 7, 8, 9, all_depths};
}

/// Adds the kernel at every depth, and at all depths with exact leaves; and the scalar reference. The kernel, which also counts who is
/// inside another, is checked.
void add_kernel(Run& run, std::deque<ShapeSet>& sets, std::vector<Subject>& points) {
  const std::vector<Shape>& shapes = run.scene.shapes();
  for (const std::uint32_t depth : depths_of(run)) {
    const ShapeSet& set = sets.emplace_back(shapes, ShapeSetPlan{{depth}});
    for (const Leaves leaves : {Leaves::discs, Leaves::segments}) {
      const bool segments = leaves == Leaves::segments;
      if (segments && depth != all_depths) continue;
      const Subject& kernel = points.emplace_back(
          subject_of(segments ? exact_leaves_name : kernel_name, set, {nullptr, leaves}, depth));
      const baselines::Reference reference(shapes, {{depth}}, leaves);
      for (const std::string_view name : requested_workloads) {
        const bench::Workload& workload = run.scene.workload(name);
        bench::require_right(
            kernel_name, workload,
            bench::wrong_answers(reference, workload.agents(), workload.pairs, answers(kernel, workload)));
      }
    }
    points.push_back(subject_of("BCH outline", run.scene.structure("reference"), depth));
  }
}

/// FCL's trees, whose times query_time has, would take most of the time.
void add_others(Run& run, Structures& structures, std::vector<Subject>& points) {
  for (const Contender& contender : contenders()) {
    if (contender.kind == "reference" || contender.kind == "paper_descent" ||
        contender.kind.starts_with("fcl"))
      continue;
    for (const std::uint32_t depth :
         contender.has_depth ? depths_of(run) : std::vector{contender.is_disc() ? 0 : all_depths}) {
      for (const std::string_view name : requested_workloads)
        structures.require_right(contender, run.scene.workload(name), depth);
      points.push_back(subject_of(contender.name, structures.of(contender), depth));
      points.back().arithmetic = contender.is_disc() ? "single" : "exact";
    }
  }
}

}  // namespace

void run_error_time(Run& run) {
  std::deque<ShapeSet> sets;
  std::vector<Subject> points;
  Structures structures(run.scene);
  add_kernel(run, sets, points);
  BodySubjects in_space(run.scene);
  in_space.add_ragdolls_and_spheres(run.sizes().max_spheres);
  for (const BodySubject& body : in_space.all()) points.push_back(body.subject);
  add_others(run, structures, points);

  SubjectTables tables(run);
  tables.add(points);
  tables.count_pairs(run.scene.workload("colliding"));
  tables.time_pairs(run.scene.workload("crowd"));
  tables.time_pairs(run.scene.workload("near_miss"));
  const SlideCases cases(run.scene.shapes(), run.sizes().cases, run.seed());
  tables.slide(cases, *baselines::fcl_mesh_distances(run.scene.bodies()));
  tables.write("error_time");
}

/// How near people come until a structure says that they collide: figure 6, left, of the paper.
void run_distance(Run& run) {
  const auto& shapes = run.scene.shapes();
  const SlideCases cases(shapes, run.sizes().cases, run.seed());
  // The hierarchies that the kernel takes are slid in one query, others step by step.
  const ShapeSet leaves(shapes), roots(shapes, {{0}});
  std::vector<Subject> subjects = {subject_of("single cylinder", roots), subject_of("BCH outline", leaves),
                                   subject_of(exact_leaves_name, leaves, {})};
  Structures structures(run.scene);
  for (const std::string_view name :
       {"BCH outline by centre", "BCH projected", "OBB outline", "OBB projected", "OBB full mesh"})
    subjects.push_back(subject_of(name, structures.of(name)));
  SubjectTables tables(run);
  tables.add(subjects);
  tables.slide(cases, *baselines::fcl_mesh_distances(run.scene.bodies()));
  tables.write("distance");
}

}  // namespace bch::report
