// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <deque>

#include <bch/scene_plan.hpp>

#include "bench/report/subjects.hpp"
#include "layout/character/skinning.hpp"

// How near people come until a structure says that they collide: figure 6, left, of the paper, and the same of characters from
// other sources.

namespace bch::report {
namespace {

constexpr double leaf_threshold = 0.01;  // metres

/// Two names in one order, whoever slides.
std::string couple(const std::string& a, const std::string& b) {
  return std::min(a, b) + " + " + std::max(a, b);
}

/// "walk" of "walk fast" or "walk_07_01".
std::string kind_of_clip(const cli::LoadedCharacter& character, PoseTime at) {
  const std::string name = cli::clip_name(character, at);
  return name.substr(0, name.find_first_of(" _"));
}

/// How far the first of the two people of each case passes beside the second, what they do, and who they are.
Table table_of(bench::Scene& scene, const SlideCases& cases) {
  Table table({"case", "beside (m)", "clips", "people"});
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto source = [&](std::size_t agent) { return scene.sources()[cases.agents().shape[agent]]; };
    const ShapeSource a = source(2 * i), b = source(2 * i + 1);
    const cli::LoadedCharacter &first = scene.characters()[a.character],
                               &second = scene.characters()[b.character];
    table.add({i, cases.agents().y[2 * i], couple(kind_of_clip(first, a.at), kind_of_clip(second, b.at)),
               couple(cli::file_name(first), cli::file_name(second))});
  }
  return table;
}

/// Slides a character in random poses, by cuts and by exact outlines.
void slide_real(Run& run, const cli::LoadedCharacter& loaded, SubjectTables& tables, Table& characters) {
  const std::span<const cli::LoadedCharacter> one(&loaded, 1);
  const std::uint32_t poses = std::min(run.sizes().poses, most_costly_poses);
  const auto sources = cli::list_random_shapes(one, poses, run.seed());
  const auto shapes = cli::build_shapes(one, sources, leaf_threshold).shapes;
  std::vector<baselines::Body> bodies;
  detail::Skinner skinner(loaded.character);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const auto positions = skinner.pose(sources[i].at);
    bodies.push_back({{positions.begin(), positions.end()}, loaded.character.triangles, shapes[i]});
  }
  std::deque<ShapeSet> sets;
  std::vector<Subject> subjects;
  for (const std::uint32_t depth : {0u, 3u, 6u, all_depths})
    subjects.push_back(subject_of(cut_name(depth), sets.emplace_back(shapes, ShapeSetPlan{{depth}})));
  const auto outlines = baselines::kind("obb_contour").build(bodies, {});
  subjects.push_back(subject_of("OBB outline", *outlines));
  tables.add(subjects, cli::file_name(loaded));
  tables.slide(SlideCases(shapes, run.sizes().cases, run.seed()), *baselines::fcl_mesh_distances(bodies));
  characters.add({cli::file_name(loaded), loaded.character.triangles.size(), shapes.size()});
}

}  // namespace

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
  run.write("distance_cases", table_of(run.scene, cases));
}

void run_real(Run& run) {
  if (run.real_characters.empty()) return;
  SubjectTables tables(run);
  Table characters({"character", "triangles", "poses"});
  for (const cli::LoadedCharacter& character : run.real_characters) {
    slide_real(run, character, tables, characters);
  }
  tables.write("real");
  run.write("real_characters", characters);
}

}  // namespace bch::report
