// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>

#include "bench/base/stopwatch.hpp"
#include "bench/report/body_subjects.hpp"

// Bodies in three dimensions: what each errs, beside the time of a pair, the bytes of a pose and the time to make one. The truth is the
// meshes, by exact tests of triangles.

namespace bch::report {
namespace {

constexpr std::size_t warming_poses = 10;

/// Adds what each subject says of the crowd's pairs, beside the meshes.
Table hits_of(const std::vector<Subject>& subjects, const bench::Workload& crowd, const bench::Hits& meshes) {
  Table table({"subject", "asked", "meshes meet", "false hits", "missed"});
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const bench::Hits hits = answers(subjects[i], crowd);
    std::size_t wrong = 0, missed = 0;
    for (std::size_t k = 0; k < hits.size(); ++k) {
      wrong += hits[k] > meshes[k] ? 1 : 0;
      missed += hits[k] < meshes[k] ? 1 : 0;
    }
    table.add({i, hits.size(), std::ranges::count(meshes, 1), wrong, missed});
  }
  return table;
}

/// Times a pose, all kinds in turn in every run; a few poses before it bring code and data into caches.
Table pose_times(const std::vector<BodySubject>& all, std::size_t shapes, std::uint32_t runs) {
  Table table({"subject", "run", "pose (us)"});
  for (std::uint32_t run = 0; run < runs; ++run)
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!all[i].pose) continue;
      for (std::size_t shape = 0; shape < shapes; shape += std::max<std::size_t>(1, shapes / warming_poses))
        all[i].pose(shape);
      const bench::Stopwatch watch(1);
      for (std::size_t shape = 0; shape < shapes; ++shape) all[i].pose(shape);
      table.add({i, run, watch.nanoseconds() / 1000 / static_cast<double>(shapes)});
    }
  return table;
}

}  // namespace

void run_bodies(Run& run) {
  BodySubjects bodies(run.scene);
  bodies.add_outlines();
  bodies.add_ragdolls_and_spheres(run.sizes().most_spheres);
  bodies.add_meshes();
  std::vector<Subject> subjects;
  for (const BodySubject& body : bodies.all()) subjects.push_back(body.subject);

  const bench::Workload& crowd = run.scene.workload("crowd");
  SubjectTables tables(run);
  tables.add(subjects);
  tables.time_pairs(crowd);
  tables.slide(SlideCases(run.scene.shapes(), run.sizes().cases, run.seed()),
               *baselines::fcl_mesh_distances(run.scene.bodies()));
  tables.write("bodies");
  run.write("bodies_hits", hits_of(subjects, crowd, run.scene.hits("obb_full", crowd)));
  run.write("bodies_poses", pose_times(bodies.all(), run.scene.shapes().size(), run.sizes().runs));
}

}  // namespace bch::report
