// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "kernel/clearance.hpp"

namespace bch::test {

/// All that clearance() says of some pairs.
struct Answers {
  std::vector<float> distance;
  std::vector<Vec2> direction;
  std::vector<CutNodes> nodes;

  explicit Answers(std::size_t size = 0) : distance(size), direction(size), nodes(size) {}
  ClearanceAnswers spans() { return {distance, direction, nodes}; }
  /// Bits, not values: -0 is not 0.
  bool same(std::size_t i, const Answers& other, std::size_t k) const {
    const auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value); };
    return bits(distance[i]) == bits(other.distance[k]) &&
           bits(direction[i].x) == bits(other.direction[k].x) &&
           bits(direction[i].y) == bits(other.direction[k].y) && nodes[i] == other.nodes[k];
  }
};

inline Answers answers(const ShapeSet& set, const Agents& agents, std::span<const Pair> pairs,
                       double max_distance, const kernel::Implementation* implementation = nullptr) {
  Answers all(pairs.size());
  clearance(set, agents, pairs, all.spans(), {max_distance, implementation});
  return all;
}

}  // namespace bch::test
