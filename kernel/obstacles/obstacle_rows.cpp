// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/obstacles/obstacle_rows.hpp"

#include <algorithm>

#include "kernel/obstacles/query_input.hpp"

namespace bch::detail {

template <class MakeQuery>
Rows<std::uint32_t> ObstacleRows::find_all(std::size_t agents, const MakeQuery& make) {
  return rows_.collect(agents, agents_per_task, [&] {
    return [query = make()](std::size_t begin, std::size_t end, const auto& add) mutable {
      for_prepared(query, begin, end, 0, Look::touching, [&](auto& prepared, std::uint32_t agent) {
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

}  // namespace bch::detail
