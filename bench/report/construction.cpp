// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/outline_builder.hpp>
#include <bch/scene_plan.hpp>
#include <bch/shapes.hpp>

#include "bench/base/stopwatch.hpp"
#include "bench/report/subjects.hpp"
#include "bench/workload/build_stages.hpp"
#include "bench/workload/scene.hpp"
#include "kernel/runtime/all_options.hpp"
#include "layout/enclosing_disc/enclosing_disc.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"

// Construction time and query time: figure 3 of the paper.

namespace bch::report {
namespace {

/// The two tables: what a structure is made from and how large it is; the time of each pose.
struct Builds {
  Table sizes{{"structure", "made from", "nodes a shape", "height"}};
  Table times{{"structure", "pose", "build (us)"}};

  void add(std::string_view structure, std::string_view from, const TreeSize& size) {
    sizes.add({structure, from, size.nodes, size.height});
  }
};

/// Times the building of something with each pose: the median of three times, so that one interruption does not count.
template <class Build>
void time_each(Table& table, std::string_view structure, std::size_t poses, Build build) {
  for (std::size_t pose = 0; pose < poses; ++pose) {
    std::vector<double> taken;
    for (int i = 0; i < 3; ++i) {
      const bench::Stopwatch watch(1);
      build(pose);
      taken.push_back(watch.nanoseconds() / 1000);
    }
    table.add({structure, pose, bench::median(taken)});
  }
}

/// Times the disc around a pose's vertices: what a single cylinder takes without an outline.
void time_single(Table& table, std::string_view name, const std::vector<baselines::Body>& bodies) {
  std::vector<Vec2> points;
  float sum = 0;
  time_each(table, name, bodies.size(), [&](std::size_t i) {
    points.clear();
    for (const Vec3& p : bodies[i].positions) points.push_back({p.x, p.y});
    sum += detail::smallest_enclosing_disc(points).centre.x;
    __asm__ volatile("" : : "g"(&sum) : "memory");  // the disc is needed
  });
}

/// A hierarchy over an outline is timed by its builder, which makes nothing besides.
void time_structure(Table& table, const Contender& contender, const std::vector<baselines::Body>& bodies) {
  if (contender.kind == "single") return time_single(table, contender.name, bodies);
  detail::HierarchyBuilder builder;
  Hierarchy hierarchy;
  const detail::SplitRule rule = contender.centre ? detail::SplitRule::centre : detail::SplitRule::centroid;
  const baselines::Kind& kind = baselines::kind(contender.kind);
  time_each(table, contender.name, bodies.size(), [&](std::size_t i) {
    if (contender.kind == "reference")
      builder.contour(bodies[i].shape.outline, 0.01f, rule, hierarchy);
    else
      kind.build(std::span(bodies).subspan(i, 1), {.fixed_radius = contender.fixed_radius});
  });
}

std::string_view made_from(const Contender& contender) {
  if (contender.is_disc()) return contender.kind == "single" ? "vertices" : "nothing";
  const bool outlined =
      contender.kind == "reference" || baselines::kind(contender.kind).exact == baselines::Truth::outline;
  return outlined ? "outline" : "triangles";
}

/// The stages of construction, over all characters.
Table time_stages(Run& run) {
  std::vector<bench::BuildStages> characters;
  for (const auto& loaded : run.scene.characters())
    characters.emplace_back(loaded.character, run.sizes().poses, bch::detail::best_build_implementation());
  Table stages({"stage", "pose", "build (us)"});
  for (const bench::BuildStage& stage : bench::build_stages) {
    for (bench::BuildStages& build : characters)
      time_each(stages, stage.name, build.poses(), [&](std::size_t i) { (build.*stage.build)(i); });
  }
  return stages;
}

}  // namespace

void run_construction(Run& run) {
  Builds builds;
  for (const Contender& contender : contenders()) {
    if (contender.kind == "paper_descent") continue;  // the same tree as the reference's
    time_structure(builds.times, contender, run.scene.bodies());
    builds.add(contender.name, made_from(contender), tree_size(contender, run.scene.bodies()));
  }
  run.write("construction", builds.sizes);
  run.write("construction_times", builds.times);
  run.write("construction_stages", time_stages(run));
}

namespace {

constexpr std::string_view paper_workloads[] = {"paper500", "paper500_cached", "colliding", "near_miss"};

/// Against brute force, disc by disc.
void require_right(Run& run, const Subject& kernel, const detail::AllOptions& query,
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
  for (const Contender& contender : contenders()) {
    subjects.push_back(subject_of(contender.name, structures.of(contender)));
    const TreeSize size = subjects.back().size = tree_size(contender, bodies);
    if (contender.kind != "bch_projected") continue;
    subjects.push_back(subject_of("BCH projected leaf discs", *leaf_discs));
    subjects.back().size = size;
  }
  SubjectTables tables(run);
  tables.add(subjects);
  for (const std::string_view name : paper_workloads) {
    const bench::Workload& workload = run.scene.workload(name);
    require_right(run, subjects[0], bench::disc_query, workload);
    require_right(run, subjects[1], {}, workload);
    for (const Contender& contender : contenders()) structures.require_right(contender, workload);
    tables.time_pairs(workload);
  }
  tables.write("query_time");
}

}  // namespace bch::report
