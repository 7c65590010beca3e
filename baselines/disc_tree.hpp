// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/hierarchy.hpp>

#include "baselines/counts.hpp"
#include "baselines/placement.hpp"
#include "baselines/traversal_stack.hpp"

namespace bch::baselines {

/// Returns whether two discs overlap by the float test, operation by operation as layout/base/rounding.hpp
/// lists it.
inline bool discs_overlap(const FloatPlacement& place, const Disc& a, const Disc& b) noexcept {
  const float x = place.x + (place.cosine * b.x - place.sine * b.y) - a.x;
  const float y = place.y + (place.sine * b.x + place.cosine * b.y) - a.y;
  const float radius_sum = a.radius + b.radius;
  return x * x + y * y <= radius_sum * radius_sum;
}

/// Returns whether every disc of one path overlaps every disc of the other. A path leads from a node up to
/// its root, so the smallest discs, which separate most pairs, come first. If all ancestors of two
/// overlapping discs of the cuts overlap, the agents collide: this is the definition of the answer.
inline bool all_overlap(const FloatPlacement& place, std::span<const Disc> path_a,
                        std::span<const Disc> path_b) noexcept {
  for (const Disc& a : path_a)
    for (const Disc& b : path_b)
      if (!discs_overlap(place, a, b)) return false;
  return true;
}

/// Returns the next node on the path down from a node to one below it, which their order tells.
template <class Node>
std::uint32_t towards(const Node* nodes, std::uint32_t from, std::uint32_t below) noexcept {
  return below < nodes[from].second_child ? from + 1 : nodes[from].second_child;
}

/// Returns the discs on the way from a node up to the root, both included.
inline std::vector<Disc> path_to(const Hierarchy::Node* nodes, std::uint32_t node) {
  std::vector<Disc> path;
  for (std::uint32_t at = 0; at != node; at = towards(nodes, at, node)) path.push_back(nodes[at].disc);
  path.push_back(nodes[node].disc);
  std::reverse(path.begin(), path.end());
  return path;
}

/// Represents the cut of a hierarchy at a depth, as a traversal sees it.
struct DiscTree {
  const Hierarchy::Node* nodes;
  std::uint32_t depth;   ///< nodes at this depth count as leaves
  std::uint32_t height;  ///< edges on the longest path down

  bool ends_at(std::uint32_t node, std::uint32_t at_depth) const noexcept {
    return at_depth == depth || nodes[node].is_leaf();
  }
};

/// Returns the answer of all_overlap() for the paths to two nodes, without listing the paths.
template <class Counts>
bool is_verified(const FloatPlacement& place, const DiscTree& a, const DiscTree& b, const NodePair& at,
                 Counts counts) noexcept {
  for (std::uint32_t i = 0;; i = towards(a.nodes, i, at.a)) {
    for (std::uint32_t j = 0;; j = towards(b.nodes, j, at.b)) {
      counts.ancestor();
      if (!discs_overlap(place, a.nodes[i].disc, b.nodes[j].disc)) return false;
      if (j == at.b) break;
    }
    if (i == at.a) return true;
  }
}

/// Walks both trees depth first, descending into the larger disc: the paper's descent. True as soon as
/// accept(pair) is true of two ends whose discs overlap. A pair is left out where two discs above it do not
/// overlap, so it passes every pair that all_overlap() is true of, and others too: not all pairs of ancestors
/// are met on the way.
template <class Counts, class Accept>
bool any_ends_overlap(const FloatPlacement& place, const DiscTree& a, const DiscTree& b, Counts counts,
                      Accept accept) {
  TraversalStack open(std::size_t{a.height} + b.height + 1);
  open.push({0, 0, 0, 0});
  while (!open.empty()) {
    const NodePair at = open.pop();
    const Hierarchy::Node &node_a = a.nodes[at.a], &node_b = b.nodes[at.b];
    counts.node();
    if (!discs_overlap(place, node_a.disc, node_b.disc)) continue;
    const bool end_a = a.ends_at(at.a, at.depth_a), end_b = b.ends_at(at.b, at.depth_b);
    if (end_a && end_b) {
      if (accept(at)) return true;
    } else if (end_b || (!end_a && node_a.disc.radius >= node_b.disc.radius)) {
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
