// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/hierarchy/builder.hpp"

// The primitives of the last hierarchy's nodes, which are added on request.

namespace bch::detail {

/// Adds every leaf's items, or the pieces of the one that is halved.
void HierarchyBuilder::add_primitives(Hierarchy& hierarchy) const {
  hierarchy.primitives.clear(), hierarchy.source.clear();
  hierarchy.primitive_ranges.resize(hierarchy.nodes.size());
  hierarchy.of_segments = threshold_ > 0;
  for (std::size_t at = 0; at < order_.size();) {
    const std::uint32_t node = first_node_[at];
    const auto begin = static_cast<std::uint32_t>(hierarchy.primitives.size());
    for (; at < order_.size() && first_node_[at] == node; ++at)
      add_pieces(items_.primitives[order_[at]], order_[at], node, hierarchy);
    hierarchy.primitive_ranges[node].begin = begin;
  }
  for (std::size_t i = hierarchy.nodes.size(); i-- > 0;)
    if (const Hierarchy::Node& node = hierarchy.nodes[i]; !node.is_leaf())
      hierarchy.primitive_ranges[i] = {hierarchy.primitive_ranges[i + 1].begin,
                                       hierarchy.primitive_ranges[node.second_child].end};
}

/// A piece's midpoint is its disc's centre.
void HierarchyBuilder::add_pieces(const Hierarchy::Primitive& piece, std::uint32_t source, std::uint32_t node,
                                  Hierarchy& hierarchy) const {
  if (const std::uint32_t second = hierarchy.nodes[node].second_child; second != 0) {
    const Disc& disc = hierarchy.nodes[node].disc;
    const Vec2 middle{disc.x, disc.y};
    add_pieces({piece.a, middle, middle}, source, node + 1, hierarchy);
    return add_pieces({middle, piece.b, piece.b}, source, second, hierarchy);
  }
  const auto begin = static_cast<std::uint32_t>(hierarchy.primitives.size());
  hierarchy.primitives.push_back(piece);
  hierarchy.source.push_back(source);
  hierarchy.primitive_ranges[node] = {begin, begin + 1};
}

}  // namespace bch::detail
