// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "tests/support/standard.hpp"

namespace bch::test {

inline bool precedes(Pair a, Pair b) {
  return std::tie(a.first, a.second) < std::tie(b.first, b.second);
}

/// Returns pairs in the order of their agents.
inline std::vector<Pair> sorted(std::span<const Pair> pairs) {
  std::vector<Pair> all(pairs.begin(), pairs.end());
  std::sort(all.begin(), all.end(), precedes);
  return all;
}

/// Returns the pairs of so many agents, in order.
inline std::vector<Pair> all_pairs(std::uint32_t count) {
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < count; ++i)
    for (std::uint32_t j = i + 1; j < count; ++j) pairs.push_back({i, j});
  return pairs;
}

/// Returns the pairs of Crowd::candidates() in a vector of their own.
inline std::vector<Pair> candidate_pairs(const ShapeSet& set, const Agents& agents, double margin = 0) {
  bch::Crowd crowd;
  const bch::Crowd::Pairs found = crowd.candidates(set, agents, margin);
  return {found.begin(), found.end()};
}

/// Returns the neighbours of each agent in pairs that a Crowd found.
inline std::vector<std::vector<std::uint32_t>> neighbours(const bch::Crowd::Pairs& pairs) {
  const Rows<bch::Crowd::Neighbour> rows = pairs.by_agent();
  std::vector<std::vector<std::uint32_t>> all(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const bch::Crowd::Neighbour& other : rows[i]) all[i].push_back(other.agent);
  return all;
}

}  // namespace bch::test
