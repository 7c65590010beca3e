// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "baselines/welzl.hpp"
#include "bench/micro/micro.hpp"
#include "bench/workload/build_stages.hpp"
#include "layout/enclosing_disc/enclosing_disc.hpp"

namespace bch::bench {
namespace {

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

/// Times one stage over all poses of the characters in turn.
void time_stage(benchmark::State& state, std::span<BuildStages> characters, const BuildStage& stage) {
  std::vector<std::pair<BuildStages*, std::size_t>> poses;
  for (BuildStages& character : characters)
    for (std::size_t pose = 0; pose < character.poses(); ++pose) poses.emplace_back(&character, pose);
  std::size_t i = 0;
  for ([[maybe_unused]] auto _ : state) {
    const auto [character, pose] = poses[i];
    (character->*stage.build)(pose);
    i = i + 1 == poses.size() ? 0 : i + 1;
  }
  state.SetItemsProcessed(state.iterations());
  state.SetLabel(std::to_string(poses.size()) + " poses in turn");
}

/// Stages made when they are first asked for, and kept until others are.
class KeptStages {
 public:
  /// `key`: what the characters are told apart by.
  template <class Make>
  std::span<BuildStages> get(std::size_t key, Make make) {
    if (key != key_ || stages_.empty()) {
      stages_.clear();
      characters_.clear();
      make(characters_, stages_);
      key_ = key;
    }
    return stages_;
  }

 private:
  std::size_t key_ = 0;
  std::deque<Character> characters_;
  std::vector<BuildStages> stages_;
};

void register_stages(Scene& scene) {
  const auto kept = std::make_shared<KeptStages>();
  const auto add = [&](const std::string& name, const BuildStage& stage, auto get) {
    benchmark::RegisterBenchmark(name.c_str(), [&stage, get](benchmark::State& state) {
      try {
        time_stage(state, get(), stage);
      } catch (const std::runtime_error& error) {
        state.SkipWithError(error.what());
      }
    })->Unit(benchmark::kMicrosecond);
  };
  const auto men = std::make_shared<const MenInDetail>();
  for (const BuildStage& stage : build_stages)
    add("build/" + std::string(stage.name), stage, [&scene, kept] {
      return kept->get(0, [&scene](auto&, auto& stages) {
        for (const auto& loaded : scene.characters())
          stages.emplace_back(loaded.character, scene.poses(), chosen_build_implementation());
      });
    });
  for (std::size_t i = 0; i < men->count(); ++i)
    for (const BuildStage& stage : build_stages)
      add("build/" + std::string(stage.name) + "/" + std::to_string(men->triangles(i)), stage,
          [&scene, kept, men, i] {
            return kept->get(i + 1, [&](auto& characters, auto& stages) {
              const Character& man = characters.emplace_back(men->make(i));
              stages.emplace_back(man, std::min(scene.poses(), men->poses(i)), chosen_build_implementation());
            });
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
    // Once more, because a scene's hierarchies have no elements.
    const Hierarchy hierarchy = contour_hierarchy(shape.outline, 0.01f);
    NodePoints& of_shape = all.emplace_back();
    auto& [points, nodes] = of_shape;
    for (const auto [first, last] : hierarchy.primitive_ranges) {
      if (last - first < 2) continue;
      const auto begin = static_cast<std::uint32_t>(points.size());
      for (std::uint32_t e = first; e < last; ++e) {
        const auto& [a, b, c] = hierarchy.primitives[e];
        if (points.size() == begin || !(points.back() == a)) points.push_back(a);
        points.push_back(b);
      }
      nodes.push_back({begin, static_cast<std::uint32_t>(points.size())});
    }
  }
  return all;
}

/// Says where our solver's discs and the textbook's differ by more than 1 um; empty: nowhere.
std::string wrong_discs(const std::vector<NodePoints>& all) {
  EnclosingDiscs ours;
  Welzl welzl;
  std::vector<SolvedDisc> discs;
  for (const auto& [points, nodes] : all) {
    if (nodes.empty()) return "a shape without discs to solve";
    discs.resize(nodes.size());
    ours.solve(points, nodes, discs);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto [begin, end] = nodes[i];
      const Welzl::Circle circle = welzl(std::span(points).subspan(begin, end - begin));
      if (!(std::abs(std::sqrt(discs[i].square_radius) - std::sqrt(circle.square_radius)) <= 1e-6))
        return "the two solvers' discs differ";
    }
  }
  return {};
}

/// The nodes' smallest enclosing discs alone; then the same by the textbook's algorithm.
void build_discs(benchmark::State& state, Scene& scene) {
  const std::vector<NodePoints> all = node_points(scene);
  if (const auto wrong = wrong_discs(all); !wrong.empty()) return state.SkipWithError(wrong.c_str());
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
  if (const auto wrong = wrong_discs(all); !wrong.empty()) return state.SkipWithError(wrong.c_str());
  Welzl solver;
  time_poses(state, scene, [&](std::size_t i) {
    for (const auto [begin, end] : all[i].nodes)
      benchmark::DoNotOptimize(solver(std::span(all[i].points).subspan(begin, end - begin)));
  });
}

/// A set of one shape: the wide tree, supports and inscribed discs.
void build_shape_set(benchmark::State& state, Scene& scene) {
  const std::span<const Shape> shapes = scene.shapes();
  time_poses(state, scene, [&](std::size_t i) {
    const ShapeSet set(shapes.subspan(i, 1), {.outlines = true});
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

/// The smallest disc around a pose's vertices: what the paper's single cylinder takes, without an outline.
void build_single_cylinder(benchmark::State& state, Scene& scene) {
  const auto& bodies = scene.bodies();
  std::vector<Vec2> points;
  const auto build = [&](std::size_t i) {
    points.clear();
    for (const Eigen::Vector3f& p : bodies[i].positions) points.push_back({p.x(), p.y()});
    return smallest_enclosing_disc(points);
  };
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (std::abs(build(i).radius - static_cast<double>(bodies[i].shape.hierarchy.nodes[0].disc.radius)) >
        1e-5)
      return state.SkipWithError("the cylinder around the vertices is not the root of the hierarchy");
  time_poses(state, scene, [&](std::size_t i) { benchmark::DoNotOptimize(build(i)); });
}

}  // namespace

void register_build_benchmarks(Scene& scene) {
  register_stages(scene);
  constexpr std::pair<const char*, void (*)(benchmark::State&, Scene&)> parts[] = {
      {"build/discs", build_discs},
      {"build/discs_by_welzl", build_discs_by_welzl},
      {"build/shape_set", build_shape_set},
      {"build/single_cylinder", build_single_cylinder}};
  for (const auto& [name, run] : parts)
    benchmark::RegisterBenchmark(name, [&scene, part = run](benchmark::State& state) {
      part(state, scene);
    })->Unit(benchmark::kMicrosecond);
  for (const baselines::Kind& kind : baselines::kinds())
    benchmark::RegisterBenchmark(("build/" + std::string(kind.name)).c_str(), [&scene, &kind](
                                                                                  benchmark::State& state) {
      build_structure(state, scene, kind);
    })->Unit(benchmark::kMicrosecond);
}

}  // namespace bch::bench
