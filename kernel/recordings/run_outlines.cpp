// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/run_bodies.hpp"

namespace bch::detail {

void RunOutlines::touch(const Agents& agents, std::span<const Pair> pairs,
                        std::span<std::uint8_t> hits) const {
  bch::collide(set(), agents, pairs, hits, {.leaves = Leaves::discs});
}

std::vector<WallDepth> RunOutlines::wall_depths(const Agents& agents, const ObstacleSet& walls) const {
  std::vector<Penetration> depths(agents.size());
  std::vector<float> gaps(agents.size());
  std::vector<DiscPair> nearest(agents.size());
  penetration(set(), agents, walls, depths);
  clearance(set(), agents, walls, {.distance = gaps, .discs = nearest}, {.overlap = Overlap::deepest});
  std::vector<WallDepth> in_walls;
  for (std::size_t i = 0; i < agents.size(); ++i)
    in_walls.push_back({nearest[i].second, depths[i].depth, static_cast<float>(depths[i].x),
                        static_cast<float>(depths[i].y)});
  return in_walls;
}

}  // namespace bch::detail
