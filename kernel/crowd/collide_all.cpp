// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <vector>

#include <bch/broad_phase.hpp>
#include <bch/collide.hpp>
#include <bch/obstacles.hpp>

#include "kernel/crowd/neighbour_rows.hpp"
#include "kernel/obstacles/obstacle_rows.hpp"
#include "kernel/runtime/task_ranges.hpp"

namespace bch {

using namespace detail;

namespace {

constexpr std::size_t crowd_grain = 4096;  ///< pairs or agents a task

}  // namespace

struct CrowdCollider::State {
  BroadPhase broad_phase;
  std::vector<std::uint8_t> hits;
  std::vector<std::uint64_t> begin;
  std::vector<std::uint32_t> neighbours;
  ObstacleRows obstacle_rows;

  Rows<std::uint32_t> collide_all(const ShapeSet& shapes, const Agents& agents, const QueryOptions& options);
};

CrowdCollider::CrowdCollider() : state_(std::make_unique<State>()) {}
CrowdCollider::CrowdCollider(CrowdCollider&&) noexcept = default;
CrowdCollider& CrowdCollider::operator=(CrowdCollider&&) noexcept = default;
CrowdCollider::~CrowdCollider() = default;

Rows<std::uint32_t> CrowdCollider::State::collide_all(const ShapeSet& shapes, const Agents& agents,
                                                      const QueryOptions& options) {
  const std::span<const Pair> pairs = broad_phase.find(shapes, agents);
  hits.resize(pairs.size());
  collide(shapes, agents, pairs, hits, options);

  begin.assign(agents.size() + 1, 0);
  NeighbourRows rows{pairs, hits, begin, {}};
  for_ranges(pairs.size(), crowd_grain,
             [&](std::size_t first, std::size_t last) { rows.count(first, last); });
  neighbours.resize(rows.place());
  rows.neighbours = neighbours;
  for_ranges(pairs.size(), crowd_grain, [&](std::size_t first, std::size_t last) { rows.fill(first, last); });
  for_ranges(agents.size(), crowd_grain,
             [&](std::size_t first, std::size_t last) { rows.sort(first, last); });
  return {begin, neighbours};
}

Rows<std::uint32_t> CrowdCollider::collide_all(const ShapeSet& shapes, const Agents& agents,
                                               const QueryOptions& options) {
  return without_tasks_from_outside([&] { return state_->collide_all(shapes, agents, options); });
}

CrowdCollisions CrowdCollider::collide_all(const ShapeSet& shapes, const Agents& agents,
                                           const ObstacleSet& obstacles, const QueryOptions& options) {
  return without_tasks_from_outside([&]() -> CrowdCollisions {
    const Rows<std::uint32_t> neighbours = state_->collide_all(shapes, agents, options);
    return {neighbours, state_->obstacle_rows.find(shapes, agents, obstacles, options)};
  });
}

}  // namespace bch
