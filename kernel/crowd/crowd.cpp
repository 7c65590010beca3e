// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/crowd.hpp>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>

#include <bch/pairs.hpp>

#include "kernel/crowd/crowd_memory.hpp"
#include "kernel/crowd/disc_radii.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/shortest.hpp"

namespace bch {

using namespace detail;

namespace {

constexpr double longest_period = 5e8;  ///< metres: images stay within the limits of positions

void require_period(double length, const char* axis) {
  if (length >= 0 && length <= longest_period) return;
  throw std::invalid_argument("crowd: expected a period along " + std::string(axis) +
                              " from 0 to 5e8 m, found " + shortest(length));
}

}  // namespace

Rows<Crowd::Neighbour> Crowd::Pairs::by_agent() const {
  if (memory_ == nullptr) return {};
  return without_tasks_from_outside([&] { return memory_->by_agent(pairs_); });
}

Rows<Crowd::Neighbour> Crowd::Pairs::nearest(std::span<const float> distance, std::uint32_t max_count) const {
  if (memory_ == nullptr) return {};
  return without_tasks_from_outside([&] { return memory_->nearest(pairs_, distance, max_count); });
}

std::vector<double> Crowd::Pairs::disc_radii(std::span<const float> distance, const Agents& agents,
                                             double alone) const {
  if (memory_ == nullptr) return std::vector<double>(agents.size(), alone);
  if (agents.size() != memory_->agents)
    throw std::invalid_argument("disc_radii: expected the " + std::to_string(memory_->agents) +
                                " agents of the clearances, found " + std::to_string(agents.size()));
  return detail::disc_radii(pairs_, distance, agents, memory_->options.period, alone);
}

Crowd::Crowd() : Crowd(CrowdOptions{}) {}
Crowd::Crowd(const CrowdOptions& options) : memory_(std::make_unique<CrowdMemory>()) {
  require_period(options.period.x, "x");
  require_period(options.period.y, "y");
  memory_->options = options;
}
Crowd::Crowd(Crowd&&) noexcept = default;
Crowd& Crowd::operator=(Crowd&&) noexcept = default;
Crowd::~Crowd() = default;

Crowd::Pairs Crowd::candidates(const ShapeSet& shapes, const Agents& agents, double margin,
                               const PairFilter& filter) & {
  return without_tasks_from_outside([&]() -> Crowd::Pairs {
    CrowdMemory& of = *memory_;
    return {of.named(of.find(shapes, agents, margin, filter).pairs), of};
  });
}

Crowd::Pairs Crowd::collisions(const ShapeSet& shapes, const Agents& agents, const CollideOptions& options,
                               const PairFilter& filter) & {
  return without_tasks_from_outside([&]() -> Crowd::Pairs {
    return memory_->keep_collisions(shapes, memory_->find(shapes, agents, 0, filter), options);
  });
}

Crowd::Pairs Crowd::candidates(const BodySet& bodies, const Agents& agents, double margin,
                               const PairFilter& filter) & {
  return without_tasks_from_outside([&]() -> Crowd::Pairs {
    CrowdMemory& of = *memory_;
    return {of.named(of.find(bodies, agents, margin, filter).pairs), of};
  });
}

Crowd::Pairs Crowd::collisions(const BodySet& bodies, const Agents& agents,
                               const Implementation* implementation, const PairFilter& filter) & {
  return without_tasks_from_outside([&]() -> Crowd::Pairs {
    return memory_->keep_collisions(bodies, memory_->find(bodies, agents, 0, filter), implementation);
  });
}

Crowd::Contacts Crowd::contacts(const ShapeSet& shapes, const Agents& agents, const CollideOptions& options,
                                const PairFilter& filter) & {
  return without_tasks_from_outside([&]() -> Crowd::Contacts {
    CrowdMemory& of = *memory_;
    const CrowdMemory::Candidates candidates = of.find(shapes, agents, 0, filter);
    const Rows<DiscPair> rows = of.disc_contacts.find_valid(shapes, candidates.agents, candidates.pairs,
                                                            options.leaves, options.implementation);
    return of.keep_rows<Crowd::Contacts>(candidates, rows);
  });
}

Rows<DiscPair> Crowd::contacts(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                               const CollideOptions& options) & {
  memory_->require_no_period();
  return without_tasks_from_outside([&] {
    return memory_->disc_contacts.find(shapes, agents, pairs, options.leaves, options.implementation);
  });
}

Crowd::BodyContacts Crowd::contacts(const BodySet& bodies, const Agents& agents,
                                    const Implementation* implementation, const PairFilter& filter) & {
  return without_tasks_from_outside([&]() -> Crowd::BodyContacts {
    CrowdMemory& of = *memory_;
    const CrowdMemory::Candidates candidates = of.find(bodies, agents, 0, filter);
    return of.keep_rows<Crowd::BodyContacts>(
        candidates, of.body_contacts.find(bodies, candidates.agents, candidates.pairs, implementation));
  });
}

Rows<Crowd::SphereContact> Crowd::contacts(const BodySet& bodies, const Agents& agents,
                                           std::span<const Pair> pairs,
                                           const Implementation* implementation) & {
  memory_->require_no_period();
  return without_tasks_from_outside(
      [&] { return memory_->body_contacts.find(bodies, agents, pairs, implementation); });
}

Crowd::Clearances Crowd::clearances(const ShapeSet& shapes, const Agents& agents,
                                    const ClearanceOptions& options, const PairFilter& filter) & {
  return without_tasks_from_outside([&]() -> Crowd::Clearances {
    CrowdMemory& of = *memory_;
    // With any margin, root discs hold all discs of their cuts, which distances are measured between.
    constexpr double least_margin = 1e-9;
    const double margin =
        options.max_distance >= 0 ? std::max(options.max_distance, least_margin) : options.max_distance;
    const CrowdMemory::Candidates candidates = of.find(shapes, agents, margin, filter);
    const auto run_query = [&] {
      clearance(shapes, candidates.agents, candidates.pairs,
                {of.distance.of_candidates, of.direction.of_candidates, of.discs.of_candidates,
                 of.points.of_candidates},
                options);
    };
    const Crowd::Pairs near = of.keep_near(candidates.pairs, run_query, of.direction, of.discs, of.points);
    return {near, of.distance.kept, of.direction.kept, of.discs.kept, of.points.kept};
  });
}

Crowd::BodyClearances Crowd::clearances(const BodySet& bodies, const Agents& agents,
                                        const BodyClearanceOptions& options, const PairFilter& filter) & {
  return without_tasks_from_outside([&]() -> Crowd::BodyClearances {
    CrowdMemory& of = *memory_;
    const CrowdMemory::Candidates candidates = of.find(bodies, agents, options.max_distance, filter);
    const auto run_query = [&] {
      clearance(bodies, candidates.agents, candidates.pairs,
                {of.distance.of_candidates, of.space_direction.of_candidates, of.discs.of_candidates,
                 of.space_points.of_candidates},
                options);
    };
    const Crowd::Pairs near =
        of.keep_near(candidates.pairs, run_query, of.space_direction, of.discs, of.space_points);
    return {near, of.distance.kept, of.space_direction.kept, of.discs.kept, of.space_points.kept};
  });
}

Crowd::Penetrations Crowd::penetrations(const ShapeSet& shapes, const Agents& agents,
                                        std::uint32_t directions, const CollideOptions& options,
                                        const PairFilter& filter) & {
  return without_tasks_from_outside([&] {
    const CrowdMemory::Candidates candidates = memory_->find(shapes, agents, 0, filter);
    memory_->keep_collisions(shapes, candidates, options);
    return memory_->penetrations_of_kept(shapes, candidates, directions, options.implementation);
  });
}

Crowd::Penetrations Crowd::penetrations(const BodySet& bodies, const Agents& agents, std::uint32_t directions,
                                        const Implementation* implementation, const PairFilter& filter) & {
  return without_tasks_from_outside([&] {
    const CrowdMemory::Candidates candidates = memory_->find(bodies, agents, 0, filter);
    memory_->keep_collisions(bodies, candidates, implementation);
    return memory_->penetrations_of_kept(bodies, candidates, directions, implementation);
  });
}

Rows<std::uint32_t> Crowd::obstacles(const ShapeSet& shapes, const Agents& agents,
                                     const ObstacleSet& obstacles, const CollideOptions& options) & {
  return without_tasks_from_outside(
      [&] { return memory_->obstacle_rows.find(shapes, agents, obstacles, options); });
}

Rows<std::uint32_t> Crowd::obstacles(const BodySet& bodies, const Agents& agents,
                                     const ObstacleSet& obstacles, const Implementation* implementation) & {
  return without_tasks_from_outside(
      [&] { return memory_->obstacle_rows.find(bodies, agents, obstacles, implementation); });
}

Crowd::Resolved Crowd::resolve(const BodySet& bodies, const Agents& agents, const ResolveOptions& options,
                               const PairFilter& filter) & {
  return without_tasks_from_outside(
      [&] { return detail::resolve(*memory_, bodies, agents, options, filter); });
}

}  // namespace bch
