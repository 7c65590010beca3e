// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/crowd/collide_all.hpp"

#include <vector>

#include "kernel/broad_phase/broad_phase.hpp"
#include "kernel/crowd/neighbour_rows.hpp"
#include "kernel/runtime/task_ranges.hpp"

namespace bch {
namespace {

constexpr std::size_t grain = 4096;  ///< pairs or agents a task

}  // namespace

struct CrowdCollider::Scratch {
  BroadPhase broad_phase;
  std::vector<std::uint8_t> hits;
  std::vector<std::uint64_t> begin;
  std::vector<std::uint32_t> neighbours;

  CollidingNeighbours collide_all(const ShapeSet& shapes, const Agents& agents, const QueryOptions& options);
};

CrowdCollider::CrowdCollider() : scratch_(std::make_unique<Scratch>()) {}
CrowdCollider::CrowdCollider(CrowdCollider&&) noexcept = default;
CrowdCollider& CrowdCollider::operator=(CrowdCollider&&) noexcept = default;
CrowdCollider::~CrowdCollider() = default;

CollidingNeighbours CrowdCollider::Scratch::collide_all(const ShapeSet& shapes, const Agents& agents,
                                                        const QueryOptions& options) {
  const std::span<const Pair> pairs = broad_phase.find(shapes, agents);
  hits.resize(pairs.size());
  collide(shapes, agents, pairs, hits, options);

  begin.assign(agents.size() + 1, 0);
  kernel::NeighbourRows rows{pairs, hits, begin, {}};
  kernel::for_ranges(pairs.size(), grain,
                     [&](std::size_t first, std::size_t last) { rows.count(first, last); });
  neighbours.resize(rows.place());
  rows.neighbours = neighbours;
  kernel::for_ranges(pairs.size(), grain,
                     [&](std::size_t first, std::size_t last) { rows.fill(first, last); });
  kernel::for_ranges(agents.size(), grain,
                     [&](std::size_t first, std::size_t last) { rows.sort(first, last); });
  return {begin, neighbours};
}

CollidingNeighbours CrowdCollider::collide_all(const ShapeSet& shapes, const Agents& agents,
                                               const QueryOptions& options) {
  return kernel::without_tasks_from_outside([&] { return scratch_->collide_all(shapes, agents, options); });
}

}  // namespace bch
