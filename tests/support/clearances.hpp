// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "baselines/clearance_reference.hpp"
#include "tests/support/scenes.hpp"

namespace bch::test {

/// The results of clearance() for some pairs, with Overlap::deepest where nothing is said.
struct Answers {
  std::vector<float> distance;
  std::vector<Vec2> direction;
  std::vector<DiscPair> discs;

  explicit Answers(std::size_t size = 0) : distance(size), direction(size), discs(size) {}
  ClearanceAnswers spans() { return {distance, direction, discs}; }
  /// Compares bits, not values: -0 is not 0.
  bool same(std::size_t i, const Answers& other, std::size_t k) const {
    const auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value); };
    return bits(distance[i]) == bits(other.distance[k]) &&
           bits(direction[i].x) == bits(other.direction[k].x) &&
           bits(direction[i].y) == bits(other.direction[k].y) && discs[i] == other.discs[k];
  }
};

inline Answers answers(const ShapeSet& set, const Agents& agents, std::span<const Pair> pairs,
                       double max_distance, const Implementation* implementation = nullptr,
                       Overlap overlap = Overlap::deepest) {
  Answers all(pairs.size());
  clearance(set, agents, pairs, all.spans(),
            {.implementation = implementation, .max_distance = max_distance, .overlap = overlap});
  return all;
}

/// Returns the way from the nearest point of a pair's first agent to that of the second, metres.
struct Way {
  double x, y;
};
inline Way way_between(const NearestPoints& points, const Crowd& crowd, Pair pair) {
  const auto& [first, second] = points;
  return {crowd.x[pair.second] - crowd.x[pair.first] + (double{second.x} - double{first.x}),
          crowd.y[pair.second] - crowd.y[pair.first] + (double{second.y} - double{first.y})};
}

/// Returns what Overlap::zero makes of such answers.
inline Answers at_least_zero(const Answers& all) {
  Answers zero;
  for (std::size_t i = 0; i < all.distance.size(); ++i) {
    const auto [distance, direction, first, second] = baselines::at_least_zero(
        {all.distance[i], all.direction[i], all.discs[i].first, all.discs[i].second});
    zero.distance.push_back(distance);
    zero.direction.push_back(direction);
    zero.discs.push_back({first, second});
  }
  return zero;
}

}  // namespace bch::test
