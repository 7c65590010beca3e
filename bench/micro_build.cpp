// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>

#include "bench/micro.hpp"
#include "layout/interior.hpp"
#include "layout/skinning.hpp"
#include "layout/union_outline.hpp"

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
  const auto& bodies = scene.bodies();
  if (union_outline(bodies[0].positions, bodies[0].triangles).points != bodies[0].shape.outline.points)
    return state.SkipWithError("an outline differs from the same outline before");
  time_poses(state, scene, [&](std::size_t i) {
    benchmark::DoNotOptimize(union_outline(bodies[i].positions, bodies[i].triangles));
  });
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
  for (const baselines::Kind& kind : baselines::kinds())
    benchmark::RegisterBenchmark(("build/" + std::string(kind.name)).c_str(), [&scene, &kind](
                                                                                  benchmark::State& state) {
      build_structure(state, scene, kind);
    })->Unit(benchmark::kMicrosecond);
}

}  // namespace bch::bench
