// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include <bch/crowd.hpp>

#include "kernel/c_api/calls.hpp"
#include "kernel/c_api/obstacles.hpp"

struct bch_crowd {
  explicit bch_crowd(const bch::CrowdOptions& options) : crowd(options) {}

  bch::Crowd crowd;
  bch::Crowd::Pairs last;                           ///< what bch_crowd_by_agent() is about
  std::optional<std::span<const float>> distances;  ///< of its pairs, where they were measured
};

using namespace bch;
using namespace bch::c_api;

namespace {

PairFilter filter_of(const bch_pair_filter* given, std::size_t agents) {
  if (given == nullptr) return {};
  const bch_pair_filter filter = sized(given, bch_pair_filter BCH_PAIR_FILTER_INIT, "filter");
  PairFilter all;
  if (filter.category != nullptr) all.category = array_of(filter.category, agents, "filter->category");
  if (filter.mask != nullptr) all.mask = array_of(filter.mask, agents, "filter->mask");
  all.excluded = same_array<Pair>(filter.excluded, filter.excluded_count, "filter->excluded");
  return all;
}

const bch_pair* c_pairs(std::span<const Pair> pairs) {
  return reinterpret_cast<const bch_pair*>(pairs.data());
}

bch_neighbour_rows neighbour_rows(const Rows<Crowd::Neighbour>& rows) {
  return {rows.size(), rows.offsets.data(), reinterpret_cast<const bch_neighbour*>(rows.values.data())};
}

bch_contact_rows contact_rows(std::span<const Pair> pairs, const Rows<DiscPair>& rows) {
  return {rows.size(), c_pairs(pairs), rows.offsets.data(),
          reinterpret_cast<const bch_disc_pair*>(rows.values.data())};
}

bch_sphere_contact_rows contact_rows(std::span<const Pair> pairs, const Rows<Crowd::SphereContact>& rows) {
  static_assert(sizeof(bch_sphere_contact) == sizeof(Crowd::SphereContact));
  return {rows.size(), c_pairs(pairs), rows.offsets.data(),
          reinterpret_cast<const bch_sphere_contact*>(rows.values.data())};
}

/// Holds the arguments of a query of a crowd. The last answer is gone as soon as the query begins.
template <class Handle>
struct CrowdCallOn : CallOn<Handle> {
  CrowdCallOn(bch_crowd* handle, const Handle* set, const bch_agents* of, const bch_pair_filter* given,
              const bch_query_options* how)
      : CallOn<Handle>(set, of, how),
        object(object_of(handle, "crowd")),
        filter(filter_of(given, this->agents.size())) {}

  /// Asks run_query(crowd) for an answer with pairs, and returns it.
  template <class RunQuery>
  auto answer(RunQuery run_query) const {
    object.last = {}, object.distances.reset();
    decltype(run_query(object.crowd)) found;
    this->run([&] { found = run_query(object.crowd); });
    return found;
  }

  bch_crowd& object;
  PairFilter filter;
};
using CrowdCall = CrowdCallOn<bch_shape_set>;
using BodyCrowdCall = CrowdCallOn<bch_body_set>;

template <class RunQuery, class Handle>
void hand_out_pairs(const CrowdCallOn<Handle>& call, RunQuery run_query, const bch_pair** pairs,
                    size_t* count) {
  required(pairs, "pairs");
  required(count, "count");
  const Crowd::Pairs found = call.answer(run_query);
  call.object.last = found;
  *pairs = c_pairs(found.span());
  *count = found.size();
}

template <class Handle>
void hand_out_candidates(const CrowdCallOn<Handle>& call, double margin, const bch_pair** pairs,
                         size_t* count) {
  const auto run_query = [&](Crowd& crowd) {
    return crowd.candidates(call.shapes, call.agents, margin, call.filter);
  };
  hand_out_pairs(call, run_query, pairs, count);
}

template <class Handle>
void hand_out_collisions(const CrowdCallOn<Handle>& call, const bch_pair** pairs, size_t* count) {
  const auto run_query = [&](Crowd& crowd) {
    return crowd.collisions(call.shapes, call.agents, call.options, call.filter);
  };
  hand_out_pairs(call, run_query, pairs, count);
}

/// Hands out the pairs of a crowd that collide, and the contacts of each.
template <class Handle, class View>
void hand_out_contacts(const CrowdCallOn<Handle>& call, View* contacts) {
  required(contacts, "contacts");
  const auto found = call.answer(
      [&](Crowd& crowd) { return crowd.contacts(call.shapes, call.agents, call.options, call.filter); });
  call.object.last = found.pairs;
  *contacts = contact_rows(found.pairs.span(), found.contacts);
}

/// Hands out the contacts of given pairs.
template <class Handle, class View>
void hand_out_contacts(const CrowdCallOn<Handle>& call, const bch_pair* pairs, std::size_t count,
                       View* contacts) {
  const std::span<const Pair> of = same_array<Pair>(pairs, count, "pairs");
  required(contacts, "contacts");
  const auto found =
      call.answer([&](Crowd& crowd) { return crowd.contacts(call.shapes, call.agents, of, call.options); });
  *contacts = contact_rows(of, found);
}

template <class Handle>
void hand_out_penetrations(const CrowdCallOn<Handle>& call, std::uint32_t directions,
                           bch_crowd_penetration_view* penetrations) {
  required(penetrations, "penetrations");
  const Crowd::Penetrations found = call.answer([&](Crowd& crowd) {
    return crowd.penetrations(call.shapes, call.agents, directions, call.options, call.filter);
  });
  call.object.last = found.pairs;
  *penetrations = {found.pairs.size(), c_pairs(found.pairs.span()),
                   reinterpret_cast<const bch_penetration_depth*>(found.penetrations.data())};
}

/// Hands out the obstacles that each agent of a set touches.
template <class Handle>
void hand_out_obstacles(bch_crowd* handle, const Handle* set, const bch_agents* agents,
                        const bch_obstacles* obstacles, const bch_query_options* options,
                        bch_index_rows* touched) {
  bch_crowd& object = object_of(handle, "crowd");
  const CallOn<Handle> call(set, agents, options);
  const ObstacleSet& walls = object_of(obstacles, "obstacles").set;
  required(touched, "touched");
  Rows<std::uint32_t> rows;
  call.run([&] { rows = object.crowd.obstacles(call.shapes, call.agents, walls, call.options); });
  *touched = {rows.size(), rows.offsets.data(), rows.values.data()};
}

Crowd::ResolveOptions resolve_options_of(const bch_resolve_options* given, std::size_t agents) {
  const auto options = sized(given, bch_resolve_options BCH_RESOLVE_OPTIONS_INIT, "resolve_options");
  Crowd::ResolveOptions all{options.directions,   options.sweeps,        options.gap,
                            options.largest_step, options.largest_shift, options.largest_turn};
  if (options.mobility != nullptr)
    all.mobility = array_of(options.mobility, agents, "resolve_options->mobility");
  if (options.obstacles != nullptr)
    all.obstacles = &object_of(options.obstacles, "resolve_options->obstacles").set;
  return all;
}

/// Returns the clearances that the crowd answered last.
/// Errors:  throws std::invalid_argument if its last answer is another.
Crowd::Clearances last_clearances(const bch_crowd& crowd) {
  if (!crowd.distances)
    throw std::invalid_argument("crowd: expected clearances as its last answer, found none");
  return {.pairs = crowd.last, .distance = *crowd.distances, .direction = {}, .discs = {}, .points = {}};
}

}  // namespace

bch_status bch_crowd_create(const bch_crowd_options* given, bch_crowd** crowd) {
  return guarded([&] {
    const bch_crowd_options defaults = BCH_CROWD_OPTIONS_INIT;
    const bch_crowd_options options = given == nullptr ? defaults : sized(given, defaults, "options");
    required(crowd, "crowd");
    const auto most = std::min<std::uint64_t>(options.max_pairs, std::numeric_limits<std::size_t>::max());
    hand_out(std::make_unique<bch_crowd>(CrowdOptions{.period = {options.period_x, options.period_y},
                                                      .max_pairs = static_cast<std::size_t>(most)}),
             crowd);
  });
}

bch_status bch_crowd_candidates(bch_crowd* handle, const bch_shape_set* set, const bch_agents* agents,
                                double margin, const bch_pair_filter* filter,
                                const bch_query_options* options, const bch_pair** pairs, size_t* count) {
  return guarded(
      [&] { hand_out_candidates(CrowdCall(handle, set, agents, filter, options), margin, pairs, count); });
}

bch_status bch_crowd_collisions(bch_crowd* handle, const bch_shape_set* set, const bch_agents* agents,
                                const bch_pair_filter* filter, const bch_query_options* options,
                                const bch_pair** pairs, size_t* count) {
  return guarded([&] { hand_out_collisions(CrowdCall(handle, set, agents, filter, options), pairs, count); });
}

bch_status bch_crowd_body_candidates(bch_crowd* handle, const bch_body_set* set, const bch_agents* agents,
                                     double margin, const bch_pair_filter* filter,
                                     const bch_query_options* options, const bch_pair** pairs,
                                     size_t* count) {
  return guarded([&] {
    hand_out_candidates(BodyCrowdCall(handle, set, agents, filter, options), margin, pairs, count);
  });
}

bch_status bch_crowd_body_collisions(bch_crowd* handle, const bch_body_set* set, const bch_agents* agents,
                                     const bch_pair_filter* filter, const bch_query_options* options,
                                     const bch_pair** pairs, size_t* count) {
  return guarded(
      [&] { hand_out_collisions(BodyCrowdCall(handle, set, agents, filter, options), pairs, count); });
}

bch_status bch_crowd_contacts(bch_crowd* handle, const bch_shape_set* set, const bch_agents* agents,
                              const bch_pair_filter* filter, const bch_query_options* options,
                              bch_contact_rows* contacts) {
  return guarded([&] { hand_out_contacts(CrowdCall(handle, set, agents, filter, options), contacts); });
}

bch_status bch_crowd_contacts_of(bch_crowd* handle, const bch_shape_set* set, const bch_agents* agents,
                                 const bch_pair* pairs, size_t count, const bch_query_options* options,
                                 bch_contact_rows* contacts) {
  return guarded(
      [&] { hand_out_contacts(CrowdCall(handle, set, agents, nullptr, options), pairs, count, contacts); });
}

bch_status bch_crowd_body_contacts(bch_crowd* handle, const bch_body_set* set, const bch_agents* agents,
                                   const bch_pair_filter* filter, const bch_query_options* options,
                                   bch_sphere_contact_rows* contacts) {
  return guarded([&] { hand_out_contacts(BodyCrowdCall(handle, set, agents, filter, options), contacts); });
}

bch_status bch_crowd_body_contacts_of(bch_crowd* handle, const bch_body_set* set, const bch_agents* agents,
                                      const bch_pair* pairs, size_t count, const bch_query_options* options,
                                      bch_sphere_contact_rows* contacts) {
  return guarded([&] {
    hand_out_contacts(BodyCrowdCall(handle, set, agents, nullptr, options), pairs, count, contacts);
  });
}

bch_status bch_crowd_clearances(bch_crowd* handle, const bch_shape_set* set, const bch_agents* agents,
                                double within, const bch_pair_filter* filter,
                                const bch_query_options* options, bch_crowd_clearance_view* clearances) {
  return guarded([&] {
    const CrowdCall call(handle, set, agents, filter, options);
    required(clearances, "clearances");
    const Crowd::Clearances found = call.answer([&](Crowd& crowd) {
      return crowd.clearances(call.shapes, call.agents, call.options.within(within), call.filter);
    });
    call.object.last = found.pairs, call.object.distances = found.distance;
    *clearances = {found.pairs.size(),
                   c_pairs(found.pairs.span()),
                   found.distance.data(),
                   reinterpret_cast<const bch_vec2*>(found.direction.data()),
                   reinterpret_cast<const bch_disc_pair*>(found.discs.data()),
                   reinterpret_cast<const bch_nearest_points*>(found.points.data())};
  });
}

bch_status bch_crowd_body_clearances(bch_crowd* handle, const bch_body_set* set, const bch_agents* agents,
                                     double within, const bch_pair_filter* filter,
                                     const bch_query_options* options,
                                     bch_crowd_body_clearance_view* clearances) {
  return guarded([&] {
    const BodyCrowdCall call(handle, set, agents, filter, options);
    required(clearances, "clearances");
    const Crowd::BodyClearances found = call.answer([&](Crowd& crowd) {
      return crowd.clearances(call.shapes, call.agents, call.options.within(within), call.filter);
    });
    call.object.last = found.pairs, call.object.distances = found.distance;
    *clearances = {found.pairs.size(),
                   c_pairs(found.pairs.span()),
                   found.distance.data(),
                   reinterpret_cast<const bch_vec3*>(found.direction.data()),
                   reinterpret_cast<const bch_disc_pair*>(found.spheres.data()),
                   reinterpret_cast<const bch_nearest_space_points*>(found.points.data())};
  });
}

bch_status bch_crowd_penetrations(bch_crowd* handle, const bch_shape_set* set, const bch_agents* agents,
                                  uint32_t directions, const bch_pair_filter* filter,
                                  const bch_query_options* options,
                                  bch_crowd_penetration_view* penetrations) {
  return guarded([&] {
    hand_out_penetrations(CrowdCall(handle, set, agents, filter, options), directions, penetrations);
  });
}

bch_status bch_crowd_body_penetrations(bch_crowd* handle, const bch_body_set* set, const bch_agents* agents,
                                       uint32_t directions, const bch_pair_filter* filter,
                                       const bch_query_options* options,
                                       bch_crowd_penetration_view* penetrations) {
  return guarded([&] {
    hand_out_penetrations(BodyCrowdCall(handle, set, agents, filter, options), directions, penetrations);
  });
}

bch_status bch_crowd_by_agent(bch_crowd* handle, bch_neighbour_rows* neighbours) {
  return guarded([&] {
    const bch_crowd& crowd = object_of(handle, "crowd");
    required(neighbours, "neighbours");
    *neighbours = neighbour_rows(crowd.last.by_agent());
  });
}

bch_status bch_crowd_nearest(bch_crowd* handle, uint32_t max_count, bch_neighbour_rows* neighbours) {
  return guarded([&] {
    const bch_crowd& crowd = object_of(handle, "crowd");
    required(neighbours, "neighbours");
    *neighbours = neighbour_rows(last_clearances(crowd).nearest(max_count));
  });
}

bch_status bch_crowd_disc_radii(const bch_crowd* handle, const bch_agents* agents, double alone,
                                double* radii) {
  return guarded([&] {
    const bch_crowd& crowd = object_of(handle, "crowd");
    const Agents all = agents_of(agents);
    required(radii, "radii");
    const std::vector<double> computed = last_clearances(crowd).disc_radii(all, alone);
    std::copy(computed.begin(), computed.end(), radii);
  });
}

bch_status bch_crowd_obstacles(bch_crowd* handle, const bch_shape_set* set, const bch_agents* agents,
                               const bch_obstacles* obstacles, const bch_query_options* options,
                               bch_index_rows* touched) {
  return guarded([&] { hand_out_obstacles(handle, set, agents, obstacles, options, touched); });
}

bch_status bch_crowd_body_obstacles(bch_crowd* handle, const bch_body_set* set, const bch_agents* agents,
                                    const bch_obstacles* obstacles, const bch_query_options* options,
                                    bch_index_rows* touched) {
  return guarded([&] { hand_out_obstacles(handle, set, agents, obstacles, options, touched); });
}

bch_status bch_crowd_body_resolve(bch_crowd* handle, const bch_body_set* set, const bch_agents* agents,
                                  const bch_resolve_options* how, const bch_pair_filter* filter,
                                  const bch_query_options* options, bch_resolved_view* resolved) {
  return guarded([&] {
    const BodyCrowdCall call(handle, set, agents, filter, options);
    Crowd::ResolveOptions all = resolve_options_of(how, call.agents.size());
    all.implementation = call.options;
    required(resolved, "resolved");
    const Crowd::Resolved found =
        call.answer([&](Crowd& crowd) { return crowd.resolve(call.shapes, call.agents, all, call.filter); });
    call.object.last = found.left;
    *resolved = {found.x.size(),
                 found.x.data(),
                 found.y.data(),
                 found.left.size(),
                 c_pairs(found.left.span()),
                 found.agents_at_walls.size(),
                 found.agents_at_walls.data(),
                 found.sweeps,
                 found.turn.empty() ? nullptr : found.turn.data()};
  });
}

bch_status bch_crowd_free(bch_crowd* crowd) {
  return free_object(crowd, "crowd");
}
