// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/workload/scene.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "baselines/reference.hpp"
#include "bench/characters/body_models.hpp"
#include "layout/character/skinning.hpp"

namespace bch::bench {
namespace {

constexpr double scene_threshold = 0.01;  ///< metres
constexpr std::uint32_t paper_cases = 500;
constexpr std::uint64_t colliding_seed = 31, near_miss_seed = 32, no_hit_seed = 33;

}  // namespace

std::string_view name_of(Leaves leaves) {
  return leaves == Leaves::segments ? "segments" : "discs";
}

Scene::Scene(SceneOptions options) : options_(std::move(options)) {}

const std::vector<cli::LoadedCharacter>& Scene::characters() {
  if (characters_.empty()) characters_ = cli::load_characters(options_.characters, {});
  return characters_;
}

const std::vector<PoseId>& Scene::sources() {
  if (sources_.empty())
    sources_ = options_.pose_seed ? cli::list_random_shapes(characters(), options_.poses, *options_.pose_seed)
                                  : cli::list_shapes(characters(), options_.poses);
  return sources_;
}

const std::vector<Shape>& Scene::shapes() {
  if (shapes_.empty()) shapes_ = cli::build_shapes(characters(), sources(), scene_threshold).shapes;
  return shapes_;
}

const std::vector<baselines::Body>& Scene::bodies() {
  if (!bodies_.empty()) return bodies_;
  for (std::size_t i = 0; i < shapes().size(); ++i) {
    const auto [index, at] = sources()[i];
    const Character& character = characters()[index].character;
    detail::Skinner skinner(character);
    const auto positions = skinner.pose(at);
    bodies_.push_back({{positions.begin(), positions.end()}, character.triangles, shapes()[i]});
  }
  return bodies_;
}

const std::vector<BodyModel>& Scene::models(std::uint32_t spheres) {
  std::vector<BodyModel>& models = models_[spheres];
  if (models.empty()) models = cli::make_models(characters(), spheres, options_.draft_models);
  return models;
}

BodySet Scene::bodies(std::uint32_t spheres) {
  return cli::posed_bodies(models(spheres), sources());
}

const ShapeSet& Scene::set() {
  if (!set_) set_.emplace(shapes());
  return *set_;
}

const baselines::Structure& Scene::structure(std::string_view kind) {
  const auto found = structures_.find(kind);
  if (found != structures_.end()) return *found->second;
  return *structures_.emplace(kind, baselines::kind(kind).build(bodies(), {})).first->second;
}

const Workload& Scene::workload(std::string_view name) {
  const auto found = workloads_.find(name);
  if (found != workloads_.end()) return found->second;
  return workloads_.emplace(name, make_workload(name)).first->second;
}

Workload Scene::make_workload(std::string_view name) {
  if (name == "colliding" || name == "near_miss") {
    const bool colliding = name == "colliding";
    const auto &meshes = structure("obb_full"), &roots = structure("single");
    return random_pairs(name, colliding ? colliding_seed : near_miss_seed, shapes(), options_.sizes.pairs,
                        [&](const Agents& agents, Pair pair) {
                          return roots.query(agents, pair) && meshes.query(agents, pair) == colliding;
                        });
  }
  if (name == "no_hit") {
    const auto &discs = structure("reference"), &roots = structure("single");
    return random_pairs(name, no_hit_seed, shapes(), options_.sizes.pairs,
                        [&](const Agents& agents, Pair pair) {
                          return roots.query(agents, pair) && !discs.query(agents, pair);
                        });
  }
  if (name == "crowd") return crowd_pairs(set(), options_.sizes.agents);
  if (name == "candidates") return crowd_pairs(set(), options_.sizes.agents, clearance_limit);
  if (name == "paper500" || name == "paper500_cached")
    return repeated(name, workload("colliding"), paper_cases, options_.sizes.pairs,
                    name == "paper500_cached");
  throw std::invalid_argument("no workload '" + std::string(name) + "'");
}

const Hits& Scene::hits(std::string_view kind, const Workload& workload) {
  Hits& hits = hits_[std::string(kind) + '/' + workload.name];
  if (!hits.empty()) return hits;
  hits.resize(workload.pairs.size());
  structure(kind).query(workload.agents(), workload.pairs, hits);
  return hits;
}

const Hits& Scene::boundary(Leaves leaves, const Workload& workload) {
  Hits& hits = hits_[fmt::format("boundary {}/{}", name_of(leaves), workload.name)];
  if (!hits.empty()) return hits;
  const baselines::Reference reference(shapes(), {}, leaves);
  const Agents agents = workload.agents();
  for (const Pair pair : workload.pairs)
    hits.push_back(reference.boundary(agents, pair, baselines::Method::brute_force));
  return hits;
}

const Hits& Scene::expected(Leaves leaves, const Workload& workload) {
  Hits& hits = hits_[fmt::format("{}/{}", name_of(leaves), workload.name)];
  if (!hits.empty()) return hits;
  hits = boundary(leaves, workload);
  const baselines::Reference reference(shapes(), {}, leaves);
  const Agents agents = workload.agents();
  for (std::size_t i = 0; i < hits.size(); ++i)
    if (hits[i] == 0) hits[i] = reference.solid(agents, workload.pairs[i], baselines::Method::depth_first);
  return hits;
}

}  // namespace bch::bench
