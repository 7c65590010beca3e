// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/cli/query_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include <bch/broad_phase.hpp>
#include <bch/clearance.hpp>
#include <bch/collide.hpp>

namespace bch::cli {
namespace {

/// Tells which pairs have a clearance.
std::vector<std::uint8_t> have_clearance(const ShapeSet& set, const Agents& agents,
                                         std::span<const Pair> pairs, const QueryOptions& options) {
  std::vector<float> distance(pairs.size());
  clearance(set, agents, pairs, {distance}, options);
  std::vector<std::uint8_t> have(pairs.size());
  std::transform(distance.begin(), distance.end(), have.begin(), [](float d) { return std::isfinite(d); });
  return have;
}

}  // namespace

std::vector<Pair> near_pairs(const ShapeSet& set, const AgentTable& table, const std::string& what,
                             const QueryOptions& options) {
  const Agents agents = table.agents();
  std::vector<Pair> pairs = candidate_pairs(set, agents, options.max_distance);
  std::sort(pairs.begin(), pairs.end(),
            [](Pair a, Pair b) { return a.first != b.first ? a.first < b.first : a.second < b.second; });
  std::vector<std::uint8_t> near(pairs.size());
  if (what == "within")
    within(set, agents, pairs, {&options.max_distance, 1}, near, options);
  else
    near = have_clearance(set, agents, pairs, options);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    pairs[kept] = pairs[i];
    kept += near[i];
  }
  pairs.resize(kept);
  return pairs;
}

std::vector<Pair> colliding_pairs(const ShapeSet& set, const Agents& agents, const QueryOptions& options) {
  CrowdCollider collider;
  const Rows<std::uint32_t> rows = collider.collide_all(set, agents, options);
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < agents.size(); ++i)
    for (const std::uint32_t j : rows[i])
      if (i < j) pairs.push_back({i, j});
  return pairs;
}

}  // namespace bch::cli
