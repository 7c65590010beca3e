// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <deque>

#include <bch/characters.hpp>

#include "bench/base/stopwatch.hpp"
#include "bench/report/subjects.hpp"
#include "bench/workload/scene.hpp"
#include "bench/workload/workload.hpp"
#include "layout/character/skinning.hpp"

// What a limit of the depth (figure 6, right, of the paper) and the detail of a mesh cost and give.

namespace bch::report {
namespace {

constexpr std::uint32_t deepest = 12;

/// Nodes of a shape down to a depth, on average.
double nodes_to_depth(std::span<const Shape> shapes, std::uint32_t depth) {
  double sum = 0;  // a binary tree of so many leaves
  for (const Shape& shape : shapes) sum += 2 * static_cast<double>(cut(shape.hierarchy, depth).size()) - 1;
  return sum / static_cast<double>(shapes.size());
}

/// Builds trees over poses of a man, and asks them for pairs of these; the meshes decide which collide.
void measure_detail(Run& run, const Character& character, SubjectTables& tables, Table& builds) {
  const std::string triangles = fmt::format("{}", character.triangles.size());
  std::vector<baselines::Body> bodies;
  detail::Skinner skinner(character);
  ShapeBuilder shape_builder(character);
  for (const PoseTime& at : sample_poses(character, std::min(run.sizes().poses, max_costly_poses))) {
    const auto positions = skinner.pose(at);
    const bench::Stopwatch watch(1);
    const Shape& shape = shape_builder.shape(at);
    builds.add({triangles, "BCH outline", bodies.size(), watch.nanoseconds() / 1000});
    bodies.push_back({{positions.begin(), positions.end()}, character.triangles, shape});
  }
  const bench::Stopwatch watch(1);
  const auto tree = baselines::kind("obb_full").build(bodies, {});
  builds.add({triangles, "OBB full mesh", "all, mean",
              watch.nanoseconds() / 1000 / static_cast<double>(bodies.size())});
  const auto plain = baselines::kind("reference").build(bodies, {}),
             roots = baselines::kind("single").build(bodies, {});
  const std::vector<Shape> shapes = shapes_of(bodies);
  const ShapeSet set(shapes);
  std::vector<Subject> subjects = {subject_of("OBB full mesh", *tree), subject_of(kernel_name, set),
                                   subject_of("BCH outline", *plain)};
  subjects[0].size = tree_size({"OBB full mesh", "obb_full"}, bodies);
  subjects[1].size = subjects[2].size = tree_size(shapes);
  tables.add(subjects, triangles);
  for (const bool colliding : {true, false}) {
    const bench::Workload workload =
        bench::random_pairs(colliding ? "colliding" : "near_miss", colliding ? 31 : 32, shapes,
                            run.sizes().pairs / 4, [&](const Agents& agents, Pair pair) {
                              return roots->query(agents, pair) && tree->query(agents, pair) == colliding;
                            });
    bench::require_right(kernel_name, workload,
                         bench::wrong_answers({shapes, {}, Leaves::discs}, workload.agents(), workload.pairs,
                                              answers(subjects[1], workload)));
    tables.time_pairs(workload);
  }
}

}  // namespace

void run_depth(Run& run) {
  const auto& shapes = run.scene.shapes();
  Structures structures(run.scene);
  std::deque<ShapeSet> sets;
  std::vector<Subject> series[4];
  for (std::uint32_t d = 0; d <= deepest + 1; ++d) {
    const std::uint32_t depth = d <= deepest ? d : all_depths;
    const ShapeSet& set = sets.emplace_back(shapes, ShapeSetPlan{{depth}});
    series[0].push_back(subject_of(kernel_name, set, bench::disc_query, depth));
    for (int k = 1; const std::string_view name : {"OBB outline", "OBB full mesh", "BCH outline"})
      series[k++].push_back(subject_of(name, structures.of(name), depth));
    series[0].back().size.nodes = series[3].back().size.nodes = nodes_to_depth(shapes, depth);
  }
  const SlideCases cases(shapes, run.sizes().cases, run.seed());
  const auto distances = baselines::fcl_mesh_distances(run.scene.bodies());
  SubjectTables tables(run);
  for (const std::vector<Subject>& subjects : series) {
    tables.add(subjects);
    tables.slide(cases, *distances);
    tables.time_pairs(run.scene.workload("colliding"));
    tables.time_pairs(run.scene.workload("near_miss"));
  }
  tables.write("depth");
}

void run_mesh_detail(Run& run) {
  Table builds({"triangles", "structure", "pose", "build (us)"});
  SubjectTables tables(run);
  const Character man = default_male();
  const Character characters[] = {man, bench::with_relief(man, 1), bench::with_relief(man, 2)};
  for (const Character& character : characters) {
    measure_detail(run, character, tables, builds);
  }
  tables.write("mesh_detail");
  run.write("mesh_detail_builds", builds);
}

}  // namespace bch::report
