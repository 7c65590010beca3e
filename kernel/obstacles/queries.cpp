// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>

#include <bch/obstacles.hpp>

#include "kernel/distance/distance_input.hpp"
#include "kernel/obstacles/obstacle_rows.hpp"
#include "kernel/obstacles/query_input.hpp"

namespace bch {

using namespace detail;

namespace {

template <class MakeQuery>
void find_hits(const MakeQuery& make, std::span<std::uint8_t> hits) {
  for_agents(hits.size(), make, 0, SearchMode::touching, [&](auto& query, std::uint32_t agent) {
    bool hit = false;
    query.visit_hits(agent, [&](std::uint32_t) { return hit = true, false; });
    hits[agent] = hit;
  });
}

template <class MakeQuery>
void find_near(const MakeQuery& make, std::span<const double> distances, std::span<std::uint8_t> answers) {
  const double most = distances.empty() ? 0 : *std::max_element(distances.begin(), distances.end());
  for_agents(answers.size(), make, most, SearchMode::nearest, [&](auto& query, std::uint32_t agent) {
    answers[agent] = query.is_within(agent, distances[distances.size() == 1 ? 0 : agent]);
  });
}

}  // namespace

void collide(const ShapeSet& shapes, const Agents& agents, const ObstacleSet& obstacles,
             std::span<std::uint8_t> hits, const CollideOptions& options) {
  const FloatingPointStateGuard floats;
  check_size({"collide", "agent", agents.size()}, hits.size(), "hits");
  find_hits(queries_of(shapes, agents, obstacles, options.implementation, "collide", options.leaves), hits);
}

void collide(const BodySet& bodies, const Agents& agents, const ObstacleSet& obstacles,
             std::span<std::uint8_t> hits, const Implementation* wanted) {
  const FloatingPointStateGuard floats;
  check_size({"collide", "agent", agents.size()}, hits.size(), "hits");
  find_hits(queries_of(bodies, agents, obstacles, wanted, "collide"), hits);
}

void within(const ShapeSet& shapes, const Agents& agents, const ObstacleSet& obstacles,
            std::span<const double> distances, std::span<std::uint8_t> answers, Leaves leaves,
            const Implementation* wanted) {
  const FloatingPointStateGuard floats;
  const QueryName context{"within", "agent", agents.size()};
  check_size(context, answers.size(), "answers");
  require_distances(context, distances);
  find_near(queries_of(shapes, agents, obstacles, wanted, "within", leaves), distances, answers);
}

void within(const BodySet& bodies, const Agents& agents, const ObstacleSet& obstacles,
            std::span<const double> distances, std::span<std::uint8_t> answers,
            const Implementation* wanted) {
  const FloatingPointStateGuard floats;
  const QueryName context{"within", "agent", agents.size()};
  check_size(context, answers.size(), "answers");
  require_distances(context, distances);
  find_near(queries_of(bodies, agents, obstacles, wanted, "within"), distances, answers);
}

namespace detail {

template <class MakeQuery>
Rows<std::uint32_t> ObstacleRows::find_all(std::size_t agents, const MakeQuery& make) {
  return rows_.collect(agents, agents_per_task, [&] {
    return [query = make()](std::size_t begin, std::size_t end, const auto& add) mutable {
      for_prepared(query, begin, end, 0, SearchMode::touching, [&](auto& prepared, std::uint32_t agent) {
        add(agent, [&](std::vector<std::uint32_t>& all) {
          const auto first = static_cast<std::ptrdiff_t>(all.size());
          prepared.visit_hits(agent, [&](std::uint32_t obstacle) { return all.push_back(obstacle), true; });
          std::sort(all.begin() + first, all.end());
        });
      });
    };
  });
}

Rows<std::uint32_t> ObstacleRows::find(const ShapeSet& shapes, const Agents& agents,
                                       const ObstacleSet& obstacles, const CollideOptions& options) {
  const FloatingPointStateGuard floats;
  return find_all(agents.size(),
                  queries_of(shapes, agents, obstacles, options.implementation, "collide", options.leaves));
}

Rows<std::uint32_t> ObstacleRows::find(const BodySet& bodies, const Agents& agents,
                                       const ObstacleSet& obstacles, const Implementation* wanted) {
  const FloatingPointStateGuard floats;
  return find_all(agents.size(), queries_of(bodies, agents, obstacles, wanted, "collide"));
}

}  // namespace detail
}  // namespace bch
