// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

#include <bch/crowd.hpp>
#include <bch/pairs.hpp>

#include "kernel/body/body_contacts.hpp"
#include "kernel/broad_phase/broad_phase.hpp"
#include "kernel/contact/disc_contacts.hpp"
#include "kernel/crowd/kept_items.hpp"
#include "kernel/crowd/periodic_agents.hpp"
#include "kernel/crowd/resolution.hpp"
#include "kernel/obstacles/obstacle_rows.hpp"
#include "layout/body/body_record.hpp"
#include "layout/body/sphere_rounding.hpp"

namespace bch::detail {

/// Holds what clearance() wrote for each candidate, and the values of those that are kept.
template <class Value>
struct AnswersOfPairs {
  std::vector<Value> of_candidates, kept;

  void keep(const KeptItems& items) {
    items.gather(kept, [&](std::size_t i) { return of_candidates[i]; });
  }
};

/// Finds the pairs of a crowd, keeps those that answer a query, and reuses its memory from call to call.
struct CrowdMemory {
  /// Holds the agents of a query, followed by their images if the crowd is periodic, and the candidate pairs among
  /// them.
  struct Candidates {
    Agents agents;
    std::span<const Pair> pairs;
  };

  bool is_periodic() const noexcept { return options.period.x > 0 || options.period.y > 0; }
  /// Throws if the crowd has a period. Pairs from the caller name agents, and cannot name an agent's periodic image.
  void require_no_period() const {
    if (is_periodic())
      throw std::invalid_argument(
          "contacts: expected a crowd without a period for given pairs, found one with");
  }
  Candidates find(const ShapeSetView& shapes, const Agents& agents, double margin, const PairFilter& filter,
                  double height_margin = 0);
  /// Finds the candidates of bodies of spheres within a distance.
  Candidates find(const BodySet& bodies, const Agents& agents, double within, const PairFilter& filter) {
    const double margin = within * (1 + rounding::bound_gap_margin);
    return find(bodies.view().ground, agents, margin, filter, margin);
  }
  Candidates find(const ShapeSet& shapes, const Agents& agents, double within, const PairFilter& filter) {
    return find(shapes.view(), agents, within, filter);
  }
  /// Returns a candidate with each image replaced by the agent of which it is the periodic image.
  Pair named(Pair candidate) const noexcept {
    return {test.origin(candidate.first), test.origin(candidate.second)};
  }
  std::span<const Pair> named(std::span<const Pair> candidates);
  /// Makes the candidates i with predicate(i) the pairs of the answer.
  template <class Predicate>
  std::span<const Pair> keep(std::span<const Pair> candidates, const Predicate& predicate) {
    kept.select(candidates.size(), predicate);
    kept.gather(pairs, [&](std::size_t i) { return named(candidates[i]); });
    return pairs;
  }
  /// Keeps the candidates that collide. `options` are those of collide().
  template <class Set, class Options>
  Crowd::Pairs keep_collisions(const Set& set, const Candidates& candidates, const Options& options) {
    hits.resize(candidates.pairs.size());
    collide(set, candidates.agents, candidates.pairs, hits, options);
    return {keep(candidates.pairs, [&](std::size_t i) { return hits[i] != 0; }), *this};
  }
  /// Runs `query`, which is penetration() or nearest_free(), for the candidates that were kept.
  template <class Set, class Query>
  void measure_kept(const Set& set, const Candidates& candidates, std::uint32_t directions,
                    const Implementation* implementation, const Query& query) {
    kept.gather(to_separate, [&](std::size_t i) { return candidates.pairs[i]; });
    penetrations.resize(to_separate.size());
    query(set, candidates.agents, to_separate, directions, penetrations, implementation);
  }
  /// Runs penetration() for the candidates that were kept.
  template <class Set>
  Crowd::Penetrations penetrations_of_kept(const Set& set, const Candidates& candidates,
                                           std::uint32_t directions, const Implementation* implementation) {
    measure_kept(set, candidates, directions, implementation, by_penetration);
    return {kept_pairs(), penetrations};
  }
  static constexpr auto by_penetration = [](auto&&... of) { penetration(of...); };
  /// Keeps the candidates whose rows are not empty, and returns them with their rows.
  template <class Answer, class Value>
  Answer keep_rows(const Candidates& candidates, const Rows<Value>& rows) {
    keep(candidates.pairs, [&](std::size_t i) { return !rows[i].empty(); });
    // Rows that are left out are empty, so only offsets change.
    kept.gather(contact_offsets, [&](std::size_t i) { return rows.offsets[i]; });
    contact_offsets.push_back(rows.values.size());
    return {kept_pairs(), {contact_offsets, rows.values}};
  }
  /// Calls run_query(), which writes the distances of the candidates, and further values of them (`others`). Then
  /// keeps the candidates of finite distance, with these values.
  template <class RunQuery, class... Value>
  Crowd::Pairs keep_near(std::span<const Pair> candidates, const RunQuery& run_query,
                         AnswersOfPairs<Value>&... others) {
    distance.of_candidates.resize(candidates.size());
    (others.of_candidates.resize(candidates.size()), ...);
    run_query();
    keep(candidates,
         [&](std::size_t i) { return distance.of_candidates[i] < std::numeric_limits<float>::infinity(); });
    distance.keep(kept);
    (others.keep(kept), ...);
    return kept_pairs();
  }
  Crowd::Pairs kept_pairs() { return {pairs, *this}; }
  Rows<Crowd::Neighbour> by_agent(std::span<const Pair> pairs);
  Rows<Crowd::Neighbour> nearest(std::span<const Pair> pairs, std::span<const float> distances,
                                 std::uint32_t max_count);

  CrowdOptions options;
  PairTest test;
  PeriodicAgents periodic;
  BroadPhase broad_phase;
  KeptItems kept;
  std::vector<std::uint8_t> hits;
  std::vector<Pair> pairs;        ///< of the answer: indices of agents
  std::vector<Pair> to_separate;  ///< pairs that collide: indices of agents and images

  DiscContacts disc_contacts;
  BodyContactRows body_contacts;
  std::vector<std::uint64_t> contact_offsets;
  AnswersOfPairs<float> distance;
  AnswersOfPairs<Vec2> direction;
  AnswersOfPairs<DiscPair> discs;
  AnswersOfPairs<NearestPoints> points;
  AnswersOfPairs<Vec3> space_direction;
  AnswersOfPairs<BodyClearanceAnswers::Points> space_points;
  std::vector<Penetration> penetrations;
  ObstacleRows obstacle_rows;
  Resolution resolution;

  std::size_t agents = 0;  ///< of the answer
  std::vector<std::uint64_t> begin, nearest_begin;
  std::vector<Crowd::Neighbour> neighbours;
};

}  // namespace bch::detail
