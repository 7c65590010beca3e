// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>

#include "bench/fine_mesh.hpp"
#include "bench/micro.hpp"
#include "bench/welzl.hpp"
#include "layout/hierarchy_builder.hpp"
#include "layout/interior.hpp"
#include "layout/outline_builder.hpp"
#include "layout/skinning.hpp"
#include "layout/wide_tree.hpp"

namespace bch::bench {
namespace {

constexpr float threshold = 0.01f;  ///< metres

/// Builds pose after pose, over and over: build(i) is about shape i of the scene.
template <class Build>
void time_poses(benchmark::State& state, Scene& scene, Build build) {
  const std::size_t count = scene.shapes().size();
  std::size_t i = 0;
  for ([[maybe_unused]] auto _ : state) {
    build(i);
    i = i + 1 == count ? 0 : i + 1;
  }
  state.SetItemsProcessed(state.iterations());
  state.SetLabel(std::to_string(count) + " poses in turn");
}

/// One a character, for what allocates the first time and never again.
std::vector<Skinner> skinners(Scene& scene) {
  std::vector<Skinner> all;
  for (const auto& loaded : scene.characters()) all.emplace_back(loaded.character);
  return all;
}

void build_skinning(benchmark::State& state, Scene& scene) {
  std::vector<Skinner> all = skinners(scene);
  const auto& sources = scene.sources();
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const auto positions = all[sources[i].character].pose(sources[i].at);
    if (!std::equal(positions.begin(), positions.end(), scene.bodies()[i].positions.begin()))
      return state.SkipWithError("a pose differs from the same pose before");
  }
  time_poses(state, scene, [&](std::size_t i) {
    benchmark::DoNotOptimize(all[sources[i].character].pose(sources[i].at).data());
  });
}

void build_outline(benchmark::State& state, Scene& scene) {
  std::vector<OutlineBuilder> builders;
  for (const auto& [source, character, report] : scene.characters())
    builders.emplace_back(character.triangles, character.vertices.size(), character.vertices);
  const auto& bodies = scene.bodies();
  const auto& sources = scene.sources();
  Outline outline;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    builders[sources[i].character].build(bodies[i].positions, outline);
    if (outline.points != bodies[i].shape.outline.points)
      return state.SkipWithError("an outline differs from the same outline before");
  }
  time_poses(state, scene, [&](std::size_t i) {
    builders[sources[i].character].build(bodies[i].positions, outline);
    benchmark::DoNotOptimize(outline.points.data());
  });
}

/// The outlines of the same poses with every triangle cut into four, as often as the argument says. The
/// outlines are the same but for rounding, so this shows how time grows with the number of triangles.
void build_finer_outline(benchmark::State& state, Scene& scene) {
  const auto& bodies = scene.bodies();
  const auto& sources = scene.sources();
  constexpr std::size_t most = 10;  // poses of a character: the finest of all would take gigabytes
  std::vector<OutlineBuilder> builders;
  std::vector<std::pair<std::size_t, std::vector<Eigen::Vector3f>>> poses;
  std::size_t triangles = 0;
  for (std::size_t c = 0; c < scene.characters().size(); ++c) {
    const Character& character = scene.characters()[c].character;
    const FineMesh mesh(character.triangles, character.vertices.size(), state.range(0));
    builders.emplace_back(mesh.triangles(), mesh.vertices(), mesh.finer(character.vertices));
    triangles += mesh.triangles().size();
    std::size_t taken = 0;
    for (std::size_t i = 0; i < bodies.size() && taken < most; ++i) {
      if (sources[i].character != c) continue;
      poses.emplace_back(c, mesh.finer(bodies[i].positions));
      ++taken;
    }
  }
  Outline outline;
  std::size_t i = 0;
  for ([[maybe_unused]] auto _ : state) {
    const auto& [character, positions] = poses[i];
    builders[character].build(positions, outline);
    benchmark::DoNotOptimize(outline.points.data());
    i = i + 1 == poses.size() ? 0 : i + 1;
  }
  state.SetItemsProcessed(state.iterations());
  state.counters["triangles"] = static_cast<double>(triangles) / static_cast<double>(builders.size());
}

void build_hierarchy(benchmark::State& state, Scene& scene) {
  const auto& shapes = scene.shapes();
  HierarchyBuilder builder;
  Hierarchy hierarchy;
  builder.contour(shapes[0].outline, threshold, SplitRule::centroid, hierarchy);
  if (hierarchy.nodes.size() != shapes[0].hierarchy.nodes.size())
    return state.SkipWithError("a hierarchy differs from the same hierarchy before");
  time_poses(state, scene, [&](std::size_t i) {
    builder.contour(shapes[i].outline, threshold, SplitRule::centroid, hierarchy);
    benchmark::DoNotOptimize(hierarchy.nodes.data());
  });
}

/// The points of every node that holds more than one segment or piece of one.
struct NodePoints {
  std::vector<Vec2> points;
  std::vector<PointRange> nodes;
};
std::vector<NodePoints> node_points(Scene& scene) {
  std::vector<NodePoints> all;
  for (const Shape& shape : scene.shapes()) {
    NodePoints& of_shape = all.emplace_back();
    auto& [points, nodes] = of_shape;
    for (const HierarchyNode& node : shape.hierarchy.nodes) {
      if (node.element_end - node.element_begin < 2) continue;
      const auto begin = static_cast<std::uint32_t>(points.size());
      for (std::uint32_t e = node.element_begin; e < node.element_end; ++e) {
        const auto& [a, b, c] = shape.hierarchy.elements[e];
        if (points.size() == begin || !(points.back() == a)) points.push_back(a);
        points.push_back(b);
      }
      nodes.push_back({begin, static_cast<std::uint32_t>(points.size())});
    }
  }
  return all;
}

/// The nodes' smallest enclosing discs alone; then the same by the textbook's algorithm.
void build_discs(benchmark::State& state, Scene& scene) {
  const std::vector<NodePoints> all = node_points(scene);
  EnclosingDiscs solver;
  std::vector<SolvedDisc> discs;
  time_poses(state, scene, [&](std::size_t i) {
    discs.resize(all[i].nodes.size());
    solver.solve(all[i].points, all[i].nodes, discs);
    benchmark::DoNotOptimize(discs.data());
  });
}
void build_discs_by_welzl(benchmark::State& state, Scene& scene) {
  const std::vector<NodePoints> all = node_points(scene);
  Welzl solver;
  time_poses(state, scene, [&](std::size_t i) {
    for (const auto [begin, end] : all[i].nodes)
      benchmark::DoNotOptimize(solver(std::span(all[i].points).subspan(begin, end - begin)));
  });
}

/// The wide trees and supports of four levels.
void build_levels(benchmark::State& state, Scene& scene) {
  const std::span<const Shape> shapes = scene.shapes();
  Flattener flattener;
  WideTree tree;
  time_poses(state, scene, [&](std::size_t i) {
    flattener.begin(shapes[i].hierarchy);
    for (const std::uint32_t depth : {0u, 3u, 6u, all_depths}) {
      flattener.flatten(depth, tree);
      benchmark::DoNotOptimize(tree.blocks.data());
      benchmark::DoNotOptimize(flattener.supports());
    }
  });
}

void build_interior(benchmark::State& state, Scene& scene) {
  const auto& shapes = scene.shapes();
  InteriorBuilder builder;
  const auto build = [&](std::size_t i) {
    return builder.build(shapes[i].outline, shapes[i].hierarchy.reach);
  };
  for (std::size_t i = 0; i < shapes.size(); ++i)
    if (build(i).radius != interior(shapes[i].outline, shapes[i].hierarchy.reach).radius)
      return state.SkipWithError("inscribed discs depend on what was built before");
  time_poses(state, scene, [&](std::size_t i) { benchmark::DoNotOptimize(build(i)); });
}

/// A set of one shape: the wide tree, supports and inscribed discs.
void build_shape_set(benchmark::State& state, Scene& scene) {
  const std::span<const Shape> shapes = scene.shapes();
  time_poses(state, scene, [&](std::size_t i) {
    const ShapeSet set(shapes.subspan(i, 1), {.solid = true});
    benchmark::DoNotOptimize(set.view());
  });
}

void build_structure(benchmark::State& state, Scene& scene, const baselines::Kind& kind) {
  const std::span<const baselines::Body> bodies = scene.bodies();
  std::size_t bytes = 0;
  time_poses(state, scene, [&](std::size_t i) {
    const auto structure = kind.build(bodies.subspan(i, 1), {});
    bytes += structure->bytes(0);
  });
  state.counters["bytes_per_shape"] = static_cast<double>(bytes) / static_cast<double>(state.iterations());
}

struct Stage {
  const char* name;
  void (*run)(benchmark::State& state, Scene& scene);
};

constexpr Stage stages[] = {
    {"build/skinning", build_skinning},   {"build/outline", build_outline},
    {"build/hierarchy", build_hierarchy}, {"build/interior", build_interior},
    {"build/discs", build_discs},         {"build/discs_by_welzl", build_discs_by_welzl},
    {"build/levels", build_levels},       {"build/shape_set", build_shape_set},
};

}  // namespace

void register_build_benchmarks(Scene& scene) {
  for (const Stage& stage : stages)
    benchmark::RegisterBenchmark(stage.name, [&scene, run = stage.run](benchmark::State& state) {
      run(state, scene);
    })->Unit(benchmark::kMicrosecond);
  benchmark::RegisterBenchmark("build/outline/subdivided",
                               [&scene](benchmark::State& state) { build_finer_outline(state, scene); })
      ->DenseRange(0, 3)
      ->Unit(benchmark::kMicrosecond);
  for (const baselines::Kind& kind : baselines::kinds())
    benchmark::RegisterBenchmark(("build/" + std::string(kind.name)).c_str(), [&scene, &kind](
                                                                                  benchmark::State& state) {
      build_structure(state, scene, kind);
    })->Unit(benchmark::kMicrosecond);
}

}  // namespace bch::bench
