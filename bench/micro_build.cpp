// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>

#include "bench/fine_mesh.hpp"
#include "bench/micro.hpp"
#include "layout/interior.hpp"
#include "layout/outline_builder.hpp"
#include "layout/skinning.hpp"

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
  if (contour_hierarchy(shapes[0].outline, threshold).nodes.size() != shapes[0].hierarchy.nodes.size())
    return state.SkipWithError("a hierarchy differs from the same hierarchy before");
  time_poses(state, scene, [&](std::size_t i) {
    benchmark::DoNotOptimize(contour_hierarchy(shapes[i].outline, threshold));
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
    {"build/shape_set", build_shape_set},
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
