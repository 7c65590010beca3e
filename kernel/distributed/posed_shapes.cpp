// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/distributed/posed_shapes.hpp"

#include <algorithm>

#include "kernel/runtime/task_ranges.hpp"
#include "layout/shape_set/builder_mark.hpp"

namespace bch::detail {
namespace {

constexpr std::uint32_t samples = 16;  ///< poses of a character
constexpr std::size_t shapes_a_task = 256;

std::vector<BakedCharacter> named(std::span<const Character> characters) {
  std::vector<BakedCharacter> all;
  for (const Character& character : characters) all.push_back({&character, character.name});
  return all;
}

}  // namespace

PosedShapes::PosedShapes(std::span<const Character> characters, const ShapeSetPlan& plan)
    : characters_(characters),
      plan_(plan),
      baker_(named(characters), plan, 0.01f),
      builder_(plan),
      set_(&builder_.set()) {}

void PosedShapes::clear() {
  builder_.rollback({});
  set_ = &builder_.set();
}

void PosedShapes::add(std::span<const DistributedCrowd::Agent> agents) {
  std::vector<PoseId> sources;
  for (const DistributedCrowd::Agent& agent : agents) sources.push_back({agent.shape, agent.pose});
  baker_.add(builder_, sources);
  set_ = &builder_.set();
}

std::vector<double> PosedShapes::radii(std::span<const DistributedCrowd::Agent> agents) const {
  std::vector<double> of_agent(agents.size()), of_character(characters_.size(), 0);
  for_ranges(agents.size(), shapes_a_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      of_agent[i] = set_->bounding_radius(static_cast<std::uint32_t>(i));
  });
  for (std::size_t i = 0; i < agents.size(); ++i) {
    double& radius = of_character[agents[i].shape];
    radius = std::max(radius, of_agent[i]);
  }
  return of_character;
}

std::vector<DistributedCrowd::Agent> sampled_agents(std::span<const Character> characters) {
  std::vector<DistributedCrowd::Agent> agents;
  for (std::uint32_t i = 0; i < characters.size(); ++i)
    for (const PoseTime& pose : sample_poses(characters[i], samples))
      agents.push_back({.shape = i, .pose = pose});
  return agents;
}

}  // namespace bch::detail
