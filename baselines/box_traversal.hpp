// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "baselines/placement.hpp"
#include "baselines/traversal_stack.hpp"

namespace bch::baselines {

/// Represents a tree of boxes or rectangles, as a traversal sees it.
template <class Node>
struct BoxHierarchy {
  const Node* nodes;
  std::uint32_t height;  ///< edges on the longest path down
};

/// Walks both trees depth first, descending into the box with the longer side. True as soon as boxes at
/// max_depth overlap, or facets_meet(a, b) is true of the facets of two leaves whose boxes overlap.
/// place(placement, node) brings a box of b into a's frame, boxes_overlap(node, placed) tests two boxes.
template <class Node, class Counts, class FacetsMeet>
bool any_facets_meet(const Placement& placement, const BoxHierarchy<Node>& a, const BoxHierarchy<Node>& b,
                     std::uint32_t max_depth, Counts counts, FacetsMeet facets_meet) {
  TraversalStack open(std::size_t{a.height} + b.height + 1);
  open.push({0, 0, 0, 0});
  auto placed = place(placement, b.nodes[0]);
  std::uint32_t placed_node = 0;
  while (!open.empty()) {
    const NodePair at = open.pop();
    const Node &node_a = a.nodes[at.a], &node_b = b.nodes[at.b];
    if (at.b != placed_node) {  // most steps descend a and keep b
      placed = place(placement, node_b);
      placed_node = at.b;
    }
    counts.node();
    if (!boxes_overlap(node_a, placed)) continue;
    const bool cut_a = at.depth_a == max_depth, cut_b = at.depth_b == max_depth;
    const bool end_a = cut_a || node_a.is_leaf(), end_b = cut_b || node_b.is_leaf();
    if (end_a && end_b) {
      if (cut_a || cut_b) return true;
      counts.leaf();
      if (facets_meet(node_a.facet(), node_b.facet())) return true;
    } else if (end_b || (!end_a && node_a.half[0] >= node_b.half[0])) {
      open.push({node_a.link, at.b, at.depth_a + 1, at.depth_b});
      open.push({at.a + 1, at.b, at.depth_a + 1, at.depth_b});
    } else {
      open.push({at.a, node_b.link, at.depth_a, at.depth_b + 1});
      open.push({at.a, at.b + 1, at.depth_a, at.depth_b + 1});
    }
  }
  return false;
}

}  // namespace bch::baselines
