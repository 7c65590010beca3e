// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <oneapi/tbb/parallel_for.h>

#include <deque>

#include <bch/scene_plan.hpp>

#include "bench/base/disc_union_area.hpp"
#include "bench/report/body_subjects.hpp"
#include "bench/workload/answer_checks.hpp"
#include "bench/workload/contender.hpp"

// What does each microsecond buy? Every structure, depth and threshold as a point.

namespace bch::report {
namespace {

/// What a structure covers beyond the outline, per cent of the area inside it, a shape; empty: not measured.
using ExcessAreas = std::vector<double>;
const ExcessAreas no_excess = {0};

/// The points, and what they refer to.
struct Points {
  std::deque<ShapeSet> sets;
  std::deque<std::unique_ptr<baselines::Structure>> structures;
  std::vector<Subject> all;
  std::vector<ExcessAreas> excess;

  Subject& add(Subject subject, ExcessAreas areas) {
    excess.push_back(std::move(areas));
    return all.emplace_back(std::move(subject));
  }
};

/// What points are asked.
constexpr std::string_view asked_workloads[] = {"crowd", "near_miss", "colliding"};

std::vector<std::uint32_t> depths_of(const Run& run, bool with_roots) {
  std::vector<std::uint32_t> depths = {0, 3, 6, 9, all_depths};
  if (run.sizes().poses >= full_sizes.poses) depths = {0, 2, 3, 4, 5, 6, 7, 8, 9, all_depths};
  if (!with_roots) depths.erase(depths.begin());
  return depths;
}

ExcessAreas excess_areas(std::span<const Shape> shapes, std::uint32_t depth) {
  ExcessAreas per_cent(shapes.size());
  tbb::parallel_for(std::size_t{0}, shapes.size(), [&](std::size_t i) {
    const Outline& outline = shapes[i].outline;
    const double covered = cli::covered_area(outline, cli::discs_of(shapes[i].hierarchy, depth));
    per_cent[i] = 100 * (covered / area(outline) - 1);
  });
  return per_cent;
}

/// Checks the kernel, which also counts who is inside another, and knows exact leaves.
void require_right(const Subject& kernel, const QueryOptions& query, std::span<const Shape> shapes,
                   const bench::Workload& workload) {
  const baselines::Reference reference(shapes, {{kernel.depth}}, query.leaves);
  bench::require_right(
      kernel_name, workload,
      bench::wrong_answers(reference, workload.agents(), workload.pairs, answers(kernel, workload)));
}

/// Adds the kernel at every depth, and at all depths with exact leaves; and the scalar reference.
void add_kernel(Run& run, double threshold, Points& points) {
  const auto bodies =
      with_hierarchies(run.scene.bodies(), static_cast<float>(threshold), SplitRule::centroid);
  const std::vector<Shape> shapes = shapes_of(bodies);
  const auto& plain = *points.structures.emplace_back(baselines::kind("reference").build(bodies, {}));
  const bool first = points.sets.empty();
  for (const std::uint32_t depth : depths_of(run, first)) {
    const ExcessAreas excess = excess_areas(shapes, depth);
    Subject slow = subject_of("BCH outline", plain, depth);
    const ShapeSet& set = points.sets.emplace_back(shapes, ShapeSetPlan{{depth}});
    for (const Leaves leaves : {Leaves::discs, Leaves::segments}) {
      const bool segments = leaves == Leaves::segments;
      if (segments && depth != all_depths) continue;
      const QueryOptions query{nullptr, leaves};
      const Subject fast = subject_of(segments ? exact_leaves_name : kernel_name, set, query, depth);
      for (const std::string_view name : asked_workloads)
        require_right(fast, query, shapes, run.scene.workload(name));
      points.add(fast, segments ? no_excess : excess).threshold = threshold;
    }
    slow.threshold = threshold;
    if (first) points.add(slow, excess);
  }
}

/// The area of the single cylinder; boxes cut short, and fixed cylinders, which do not cover outlines, are not measured.
ExcessAreas excess_of(Run& run, const Contestant& contestant, std::uint32_t depth) {
  if (contestant.kind == "single") return excess_areas(run.scene.shapes(), 0);
  return depth == all_depths ? no_excess : ExcessAreas{};
}

void add_others(Run& run, Structures& structures, Points& points) {
  for (const Contestant& contestant : contestants()) {
    if (contestant.kind == "reference" || contestant.kind == "paper_descent") continue;
    for (const std::uint32_t depth :
         contestant.has_depth ? depths_of(run, true) : std::vector{contestant.is_disc() ? 0 : all_depths}) {
      for (const std::string_view name : asked_workloads)
        structures.require_right(contestant, run.scene.workload(name), depth);
      points
          .add(subject_of(contestant.name, structures.of(contestant), depth),
               excess_of(run, contestant, depth))
          .arithmetic = contestant.kind.starts_with("fcl") ? "double"
                        : contestant.is_disc()             ? "single"
                                                           : "exact";
    }
  }
}

}  // namespace

void run_error_time(Run& run) {
  Points points;
  Structures structures(run.scene);
  const bool full = run.sizes().poses >= full_sizes.poses;
  for (const double threshold : full ? std::vector{0.01, 0.005, 0.02, 0.04} : std::vector{0.01, 0.04})
    add_kernel(run, threshold, points);
  BodySubjects in_space(run.scene);
  in_space.add_ragdolls_and_spheres(run.sizes().most_spheres);
  for (const BodySubject& body : in_space.all()) points.add(body.subject, {});
  add_others(run, structures, points);

  Table areas({"subject", "shape", "excess area (%)"});
  for (std::size_t i = 0; i < points.all.size(); ++i)
    for (std::size_t k = 0; k < points.excess[i].size(); ++k) areas.add({i, k, points.excess[i][k]});
  run.write("error_time_areas", areas);
  SubjectTables tables(run);
  tables.add(points.all);
  tables.count_pairs(run.scene.workload("colliding"));
  tables.time_pairs(run.scene.workload("crowd"));
  tables.time_pairs(run.scene.workload("near_miss"));
  const SlideCases cases(run.scene.shapes(), run.sizes().cases, run.seed());
  tables.slide(cases, *baselines::fcl_mesh_distances(run.scene.bodies()));
  tables.write("error_time");
}

}  // namespace bch::report
