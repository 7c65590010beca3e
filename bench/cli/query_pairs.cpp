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

std::vector<Pair> all_pairs(const ShapeSet& set, const AgentTable& table, const std::string& what,
                            const QueryOptions& options, std::size_t most) {
  const Agents agents = table.agents();
  const bool of_distance = std::isfinite(options.max_distance);
  std::vector<Pair> pairs = candidate_pairs(set, agents, of_distance ? options.max_distance : 0, most);
  std::sort(pairs.begin(), pairs.end(),
            [](Pair a, Pair b) { return a.first != b.first ? a.first < b.first : a.second < b.second; });
  std::vector<std::uint8_t> kept(pairs.size());
  if (!of_distance)
    collide(set, agents, pairs, kept, options);
  else if (what == "within")
    within(set, agents, pairs, {&options.max_distance, 1}, kept, options);
  else
    kept = have_clearance(set, agents, pairs, options);
  std::size_t count = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    pairs[count] = pairs[i];
    count += kept[i];
  }
  pairs.resize(count);
  return pairs;
}

}  // namespace bch::cli
