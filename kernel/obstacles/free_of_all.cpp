// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <vector>

#include <bch/obstacles.hpp>

#include "kernel/obstacles/free_walls.hpp"
#include "kernel/obstacles/sphere_query.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/spares.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/floating_point_state.hpp"

namespace bch {

using namespace detail;

namespace {

constexpr std::size_t movers_per_task = 16;
constexpr std::size_t hits_per_task = 64;

/// Holds the neighbours of each agent, one agent's after the other's, ascending: so that no order of pairs matters.
struct NeighboursOf {
  std::vector<std::size_t> begins;  ///< by agent, and the end of all
  std::vector<std::uint32_t> all;

  NeighboursOf(std::size_t agents, std::span<const Pair> pairs) : begins(agents + 1), all(pairs.size()) {
    for (const Pair pair : pairs) ++begins[pair.first];
    std::size_t end = 0;
    for (std::size_t& of_agent : begins) of_agent = end += of_agent;
    for (const Pair pair : pairs) all[--begins[pair.first]] = pair.second;
    for (std::size_t agent = 0; agent < agents; ++agent)
      std::sort(all.begin() + static_cast<std::ptrdiff_t>(begins[agent]),
                all.begin() + static_cast<std::ptrdiff_t>(begins[agent + 1]));
  }
  std::span<const std::uint32_t> operator[](std::size_t agent) const {
    return std::span(all).subspan(begins[agent], begins[agent + 1] - begins[agent]);
  }
};

/// Returns the agents that collide with some neighbour, ascending, or that `hits` marks already.
template <class Source>
std::vector<std::uint32_t> find_movers(const Source& source, std::span<const Pair> pairs,
                                       std::vector<std::uint8_t>& hits) {
  std::vector<std::uint8_t> collide(pairs.size());
  for_pair_ranges(pairs.size(), hits_per_task, [&](std::size_t begin, std::size_t size) {
    source.find_hits(source.agents(), pairs.subspan(begin, size), collide.data() + begin);
  });
  for (std::size_t i = 0; i < pairs.size(); ++i) hits[pairs[i].first] |= collide[i];
  std::vector<std::uint32_t> movers;
  for (std::uint32_t agent = 0; agent < hits.size(); ++agent)
    if (hits[agent] != 0) movers.push_back(agent);
  return movers;
}

/// Finds the ways of agents, with searches that make_search() returns. They need memory, so answers are written once all have ended.
template <class Source, class MakeSearch>
void free_all(const Source& source, std::span<const Pair> pairs, std::vector<std::uint8_t> hits,
              const Axes& axes, std::span<Penetration> out, std::span<Penetration::Touch> to_touches,
              const MakeSearch& make_search) {
  const std::vector<std::uint32_t> movers = find_movers(source, pairs, hits);
  const NeighboursOf neighbours(hits.size(), pairs);
  std::vector<Penetration> ways(hits.size(), {0, 1, 0});
  std::vector<Penetration::Touch> touches(to_touches.size());
  Spares<decltype(make_search())> spares;
  for_ranges(movers.size(), movers_per_task, [&](std::size_t begin, std::size_t end) {
    const auto search = spares.borrow(make_search);
    for (std::size_t i = begin; i < end; ++i) {
      const FreeWay way = search->find(movers[i], neighbours[movers[i]], axes);
      ways[movers[i]] = {way.place, way.x, way.y};
      if (!touches.empty()) touches[movers[i]] = search->touch(way);
    }
  });
  std::copy(ways.begin(), ways.end(), out.begin());
  std::copy(touches.begin(), touches.end(), to_touches.begin());
}

/// Finds the ways of agents. make_query(agents, obstacles) returns the query of an agent, and mark_hits(obstacles, hits) marks who collides.
template <class Query, class Source, class MakeQuery, class MarkHits>
void free_all(const Source& source, std::span<const Pair> pairs, const ObstacleSet* obstacles,
              std::uint32_t directions, std::span<Penetration> out, std::span<Penetration::Touch> touches,
              const MakeQuery& make_query, const MarkHits& mark_hits) {
  const Axes axes = spread_axes("nearest_free", directions);
  std::vector<std::uint8_t> hits(source.agents().size());
  if (obstacles == nullptr)
    return free_all(source, pairs, std::move(hits), axes, out, touches,
                    [&] { return FreeWaySearch<Source, NoWalls>(source); });
  mark_hits(*obstacles, hits);
  const auto make = [&](const Agents& one) { return make_query(one, obstacles->view()); };
  free_all(source, pairs, std::move(hits), axes, out, touches,
           [&] { return FreeWaySearch<Source, ObstacleWalls<Query, Source>>(source, source, make); });
}

void check_answers(std::size_t agents, std::span<Penetration> out, std::span<Penetration::Touch> touches) {
  check_size({"nearest_free", "agent", agents}, out.size(), "answers");
  if (!touches.empty()) check_size({"nearest_free", "agent", agents}, touches.size(), "touches");
}

}  // namespace

void nearest_free(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> neighbours,
                  const ObstacleSet* obstacles, std::uint32_t directions, std::span<Penetration> out,
                  const CollideOptions& options, std::span<Penetration::Touch> touches) {
  const FloatingPointStateGuard floats;
  check_answers(agents.size(), out, touches);
  const bool exact = exact_leaves(shapes, options.leaves, "nearest_free");
  const Implementation& implementation = chosen(options.implementation, "nearest_free");
  validate(shapes, agents);
  require_valid(implementation, shapes.view(), agents, neighbours);
  free_all<BodyQuery>(
      OutlineSource(shapes, agents, implementation, exact), neighbours, obstacles, directions, out, touches,
      [&](const Agents& one, const ObstacleView& view) {
        return BodyQuery(implementation, shapes.view(), one, view, exact);
      },
      [&](const ObstacleSet& of, std::span<std::uint8_t> hits) {
        collide(shapes, agents, of, hits, options);
      });
}

void nearest_free(const BodySet& bodies, const Agents& agents, std::span<const Pair> neighbours,
                  const ObstacleSet* obstacles, std::uint32_t directions, std::span<Penetration> out,
                  const Implementation* wanted, std::span<Penetration::Touch> touches) {
  const FloatingPointStateGuard floats;
  check_answers(agents.size(), out, touches);
  const Implementation& implementation = chosen(wanted, "nearest_free");
  require_valid_agents(bodies.view().ground, agents);
  require_valid(implementation, bodies.view().ground, agents, neighbours);
  free_all<SphereQuery>(
      SphereSource(bodies.view(), agents, implementation), neighbours, obstacles, directions, out, touches,
      [&](const Agents& one, const ObstacleView& view) {
        return SphereQuery(implementation, bodies.view(), one, view);
      },
      [&](const ObstacleSet& of, std::span<std::uint8_t> hits) {
        collide(bodies, agents, of, hits, wanted);
      });
}

}  // namespace bch
