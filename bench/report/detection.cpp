// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <deque>

#include <bch/scene_plan.hpp>

#include "bench/report/subjects.hpp"
#include "layout/character/skinning.hpp"

// How near people come until a structure says that they collide: figure 6, left, of the paper.

namespace bch::report {

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
