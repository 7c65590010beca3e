// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>

#include "baselines/counts.hpp"
#include "baselines/placement.hpp"
#include "baselines/traversal_stack.hpp"
#include "layout/hierarchy.hpp"

namespace bch::baselines {

/// The float test of two discs, operation by operation as layout/rounding.hpp lists it.
inline bool discs_overlap(const FloatPlacement& place, const Disc& a, float radius_a, const Disc& b,
                          float radius_b) noexcept {
  const float x = place.x + (place.cosine * b.x - place.sine * b.y) - a.x;
  const float y = place.y + (place.sine * b.x + place.cosine * b.y) - a.y;
  const float radius_sum = radius_a + radius_b;
  return x * x + y * y <= radius_sum * radius_sum;
}

/// The cut of a hierarchy at a depth, as a traversal walks it.
struct DiscTree {
  const HierarchyNode* nodes;
  const float* bounds;   ///< bounding_radii()
  std::uint32_t depth;   ///< nodes at this depth count as leaves
  std::uint32_t height;  ///< edges on the longest way down

  bool ends_at(std::uint32_t node, std::uint32_t at_depth) const noexcept {
    return at_depth == depth || nodes[node].is_leaf();
  }
  /// An inner node prunes, so it has to hold the discs below it; a leaf gives the answer.
  float radius(std::uint32_t node, bool end) const noexcept {
    return end ? nodes[node].disc.radius : bounds[node];
  }
};

/// Walks both trees depth first, descending into the larger disc. True as soon as accept(pair) is true of two
/// ends whose discs overlap.
template <class Counts, class Accept>
bool any_ends_overlap(const FloatPlacement& place, const DiscTree& a, const DiscTree& b, Counts counts,
                      Accept accept) {
  TraversalStack open(std::size_t{a.height} + b.height + 1);
  open.push({0, 0, 0, 0});
  while (!open.empty()) {
    const NodePair at = open.pop();
    const HierarchyNode &node_a = a.nodes[at.a], &node_b = b.nodes[at.b];
    const bool end_a = a.ends_at(at.a, at.depth_a), end_b = b.ends_at(at.b, at.depth_b);
    const float radius_a = a.radius(at.a, end_a), radius_b = b.radius(at.b, end_b);
    counts.node();
    if (!discs_overlap(place, node_a.disc, radius_a, node_b.disc, radius_b)) continue;
    if (end_a && end_b) {
      if (accept(at)) return true;
    } else if (end_b || (!end_a && radius_a >= radius_b)) {
      open.push({node_a.second_child, at.b, at.depth_a + 1, at.depth_b});
      open.push({at.a + 1, at.b, at.depth_a + 1, at.depth_b});
    } else {
      open.push({at.a, node_b.second_child, at.depth_a, at.depth_b + 1});
      open.push({at.a, at.b + 1, at.depth_a, at.depth_b + 1});
    }
  }
  return false;
}

}  // namespace bch::baselines
