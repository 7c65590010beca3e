// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/crowd.hpp>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <bch/pairs.hpp>

#include "kernel/body/body_contacts.hpp"
#include "kernel/broad_phase/broad_phase.hpp"
#include "kernel/contact/disc_contacts.hpp"
#include "kernel/crowd/kept_items.hpp"
#include "kernel/crowd/neighbour_rows.hpp"
#include "kernel/crowd/periodic_agents.hpp"
#include "kernel/obstacles/obstacle_rows.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/floating_point_state.hpp"
#include "layout/base/shortest.hpp"
#include "layout/body/body_record.hpp"
#include "layout/body/sphere_rounding.hpp"

namespace bch::detail {
namespace {

constexpr std::size_t crowd_grain = 4096;  ///< pairs or agents a task
constexpr double longest_period = 5e8;     ///< metres: images stay within the limits of positions

void require_period(double length, const char* axis) {
  if (length >= 0 && length <= longest_period) return;
  throw std::invalid_argument("crowd: expected a period along " + std::string(axis) +
                              " from 0 to 5e8 m, found " + shortest(length));
}

/// Holds a value of each candidate that clearance() gave, and of those that are kept.
template <class Value>
struct Answers {
  std::vector<Value> of_candidates, kept;

  void keep(const KeptItems& items) {
    items.gather(kept, [&](std::size_t i) { return of_candidates[i]; });
  }
};

}  // namespace

struct CrowdMemory {
  /// Agents of a query, images behind them where the crowd is periodic, and the pairs of these that are candidates.
  struct Candidates {
    Agents agents;
    std::span<const Pair> pairs;
  };

  bool is_periodic() const noexcept { return options.period.x > 0 || options.period.y > 0; }
  /// Given pairs name agents, not images of them.
  void require_no_period() const {
    if (is_periodic())
      throw std::invalid_argument(
          "contacts: expected a crowd without a period for given pairs, found one with");
  }
  Candidates find(const ShapeSetView& shapes, const Agents& agents, double margin, const PairFilter& filter,
                  double height_margin = 0);
  /// Finds those of bodies of spheres that may be within a distance.
  Candidates find(const BodySet& bodies, const Agents& agents, double within, const PairFilter& filter) {
    const double margin = within * (1 + rounding::bound_share);
    return find(bodies.view().ground, agents, margin, filter, margin);
  }
  std::span<const Pair> collide(const ShapeSet& shapes, const Candidates& candidates, Leaves leaves,
                                const Implementation* implementation);
  std::span<const Pair> collide(const BodySet& bodies, const Candidates& candidates,
                                const Implementation* implementation);
  /// Keeps the candidates whose rows are not empty, and returns them with their rows.
  template <class Answer, class Value>
  Answer keep_rows(const Candidates& candidates, const Rows<Value>& rows);
  /// Measures the candidates that were kept.
  template <class Set>
  Crowd::Penetrations penetrations_of_kept(const Set& set, const Candidates& candidates,
                                           std::uint32_t directions, const Implementation* implementation);
  Pair named(Pair candidate) const noexcept {
    return {test.origin(candidate.first), test.origin(candidate.second)};
  }
  std::span<const Pair> named(std::span<const Pair> candidates);
  /// Keeps the candidates i for which keeps(i), and makes them the pairs of the answer.
  template <class Keeps>
  std::span<const Pair> keep(std::span<const Pair> candidates, const Keeps& keeps) {
    kept.select(candidates.size(), keeps);
    kept.gather(pairs, [&](std::size_t i) { return named(candidates[i]); });
    return pairs;
  }
  /// Keeps the candidates that were hits.
  std::span<const Pair> keep_hits(std::span<const Pair> candidates) {
    return keep(candidates, [&](std::size_t i) { return hits[i] != 0; });
  }
  /// Asks ask() for the distances of the candidates and what goes with them, and keeps those that are near.
  template <class Ask, class... Value>
  Crowd::Pairs keep_near(std::span<const Pair> candidates, const Ask& ask, Answers<Value>&... beside) {
    distance.of_candidates.resize(candidates.size());
    (beside.of_candidates.resize(candidates.size()), ...);
    ask();
    keep(candidates,
         [&](std::size_t i) { return distance.of_candidates[i] < std::numeric_limits<float>::infinity(); });
    distance.keep(kept);
    (beside.keep(kept), ...);
    return {pairs, *this};
  }
  Rows<Crowd::Neighbour> by_agent(std::span<const Pair> pairs);

  CrowdOptions options;
  PairTest test;
  PeriodicAgents periodic;
  BroadPhase broad_phase;
  KeptItems kept;
  std::vector<std::uint8_t> hits;
  std::vector<Pair> pairs;    ///< of the answer, that names agents
  std::vector<Pair> to_part;  ///< pairs that collide, as candidates name them

  DiscContacts disc_contacts;
  BodyContactRows body_contacts;
  std::vector<std::uint64_t> contact_offsets;
  Answers<float> distance;
  Answers<Vec2> direction;
  Answers<DiscPair> discs;
  Answers<NearestPoints> points;
  Answers<Vec3> space_direction;
  Answers<BodyClearanceAnswers::Points> space_points;
  std::vector<Penetration> penetrations;
  ObstacleRows obstacle_rows;

  std::size_t agents = 0;  ///< of the answer
  std::vector<std::uint64_t> begin;
  std::vector<Crowd::Neighbour> neighbours;
};

CrowdMemory::Candidates CrowdMemory::find(const ShapeSetView& shapes, const Agents& given, double margin,
                                          const PairFilter& filter, double height_margin) {
  const FloatingPointStateGuard floats;
  Candidates found{given, {}};
  agents = given.size();
  if (is_periodic()) {
    require_valid_agents(shapes, given);
    require_margin(margin);
    periodic.set(shapes, given, options.period, margin);
    found.agents = periodic.agents();
  }
  test.set(
      filter, given.size(),
      found.agents.shape.size() > agents ? periodic.origin_of_image() : std::span<const std::uint32_t>());
  found.pairs = broad_phase.find(shapes, found.agents, margin, options.most_pairs,
                                 test.accepts_all() ? nullptr : &test, height_margin);
  return found;
}

/// Returns pairs of agents, where candidates are pairs of images.
std::span<const Pair> CrowdMemory::named(std::span<const Pair> candidates) {
  if (!is_periodic()) return candidates;
  pairs.resize(candidates.size());
  for_ranges(pairs.size(), crowd_grain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) pairs[i] = named(candidates[i]);
  });
  return pairs;
}

/// Keeps the candidates that collide.
std::span<const Pair> CrowdMemory::collide(const ShapeSet& shapes, const Candidates& candidates,
                                           Leaves leaves, const Implementation* implementation) {
  hits.resize(candidates.pairs.size());
  bch::collide(shapes, candidates.agents, candidates.pairs, hits,
               {.implementation = implementation, .leaves = leaves});
  return keep_hits(candidates.pairs);
}

std::span<const Pair> CrowdMemory::collide(const BodySet& bodies, const Candidates& candidates,
                                           const Implementation* implementation) {
  hits.resize(candidates.pairs.size());
  bch::collide(bodies, candidates.agents, candidates.pairs, hits, implementation);
  return keep_hits(candidates.pairs);
}

template <class Answer, class Value>
Answer CrowdMemory::keep_rows(const Candidates& candidates, const Rows<Value>& rows) {
  keep(candidates.pairs, [&](std::size_t i) { return !rows[i].empty(); });
  // Rows that are left out are empty, so only offsets move.
  kept.gather(contact_offsets, [&](std::size_t i) { return rows.offsets[i]; });
  contact_offsets.push_back(rows.values.size());
  return {{pairs, *this}, {contact_offsets, rows.values}};
}

template <class Set>
Crowd::Penetrations CrowdMemory::penetrations_of_kept(const Set& set, const Candidates& candidates,
                                                      std::uint32_t directions,
                                                      const Implementation* implementation) {
  kept.gather(to_part, [&](std::size_t i) { return candidates.pairs[i]; });
  penetrations.resize(to_part.size());
  penetration(set, candidates.agents, to_part, directions, penetrations, implementation);
  return {{pairs, *this}, penetrations};
}

Rows<Crowd::Neighbour> CrowdMemory::by_agent(std::span<const Pair> of) {
  if (of.size() > std::numeric_limits<std::uint32_t>::max())
    throw std::length_error("by_agent: expected fewer than 2^32 pairs, found " + std::to_string(of.size()));
  begin.assign(agents + 1, 0);
  NeighbourRows rows{of, begin, {}};
  const auto for_pairs = [&](auto pass) {
    for_ranges(of.size(), crowd_grain,
               [&](std::size_t first, std::size_t last) { (rows.*pass)(first, last); });
  };
  for_pairs(&NeighbourRows::count);
  neighbours.resize(rows.accumulate());
  rows.neighbours = neighbours;
  for_pairs(&NeighbourRows::fill);
  for_ranges(agents, crowd_grain, [&](std::size_t first, std::size_t last) { rows.sort(first, last); });
  return {begin, neighbours};
}

}  // namespace bch::detail

namespace bch {

using namespace detail;

Rows<Crowd::Neighbour> Crowd::Pairs::by_agent() const {
  if (memory_ == nullptr) return {};
  return without_tasks_from_outside([&] { return memory_->by_agent(pairs_); });
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
    return {of.named(of.find(shapes.view(), agents, margin, filter).pairs), of};
  });
}

Crowd::Pairs Crowd::collisions(const ShapeSet& shapes, const Agents& agents, const CollideOptions& options,
                               const PairFilter& filter) & {
  return without_tasks_from_outside([&]() -> Crowd::Pairs {
    CrowdMemory& of = *memory_;
    const CrowdMemory::Candidates candidates = of.find(shapes.view(), agents, 0, filter);
    return {of.collide(shapes, candidates, options.leaves, options.implementation), of};
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
    CrowdMemory& of = *memory_;
    const CrowdMemory::Candidates candidates = of.find(bodies, agents, 0, filter);
    return {of.collide(bodies, candidates, implementation), of};
  });
}

Crowd::Contacts Crowd::contacts(const ShapeSet& shapes, const Agents& agents, const CollideOptions& options,
                                const PairFilter& filter) & {
  return without_tasks_from_outside([&]() -> Crowd::Contacts {
    CrowdMemory& of = *memory_;
    const CrowdMemory::Candidates candidates = of.find(shapes.view(), agents, 0, filter);
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
    const CrowdMemory::Candidates candidates = of.find(shapes.view(), agents, margin, filter);
    const auto ask = [&] {
      clearance(shapes, candidates.agents, candidates.pairs,
                {of.distance.of_candidates, of.direction.of_candidates, of.discs.of_candidates,
                 of.points.of_candidates},
                options);
    };
    const Crowd::Pairs near = of.keep_near(candidates.pairs, ask, of.direction, of.discs, of.points);
    return {near, of.distance.kept, of.direction.kept, of.discs.kept, of.points.kept};
  });
}

Crowd::BodyClearances Crowd::clearances(const BodySet& bodies, const Agents& agents,
                                        const BodyClearanceOptions& options, const PairFilter& filter) & {
  return without_tasks_from_outside([&]() -> Crowd::BodyClearances {
    CrowdMemory& of = *memory_;
    const CrowdMemory::Candidates candidates = of.find(bodies, agents, options.max_distance, filter);
    const auto ask = [&] {
      clearance(bodies, candidates.agents, candidates.pairs,
                {of.distance.of_candidates, of.space_direction.of_candidates, of.discs.of_candidates,
                 of.space_points.of_candidates},
                options);
    };
    const Crowd::Pairs near =
        of.keep_near(candidates.pairs, ask, of.space_direction, of.discs, of.space_points);
    return {near, of.distance.kept, of.space_direction.kept, of.discs.kept, of.space_points.kept};
  });
}

Crowd::Penetrations Crowd::penetrations(const ShapeSet& shapes, const Agents& agents,
                                        std::uint32_t directions, const CollideOptions& options,
                                        const PairFilter& filter) & {
  return without_tasks_from_outside([&] {
    const CrowdMemory::Candidates candidates = memory_->find(shapes.view(), agents, 0, filter);
    memory_->collide(shapes, candidates, options.leaves, options.implementation);
    return memory_->penetrations_of_kept(shapes, candidates, directions, options.implementation);
  });
}

Crowd::Penetrations Crowd::penetrations(const BodySet& bodies, const Agents& agents, std::uint32_t directions,
                                        const Implementation* implementation, const PairFilter& filter) & {
  return without_tasks_from_outside([&] {
    const CrowdMemory::Candidates candidates = memory_->find(bodies, agents, 0, filter);
    memory_->collide(bodies, candidates, implementation);
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

}  // namespace bch
