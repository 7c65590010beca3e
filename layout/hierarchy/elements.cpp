// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/hierarchy/builder.hpp"

// What the nodes of the last hierarchy hold, for who asks.

namespace bch {

/// A leaf's items, or the pieces of the one that is halved.
void HierarchyBuilder::add_elements(Hierarchy& hierarchy) const {
  hierarchy.elements.clear(), hierarchy.source.clear();
  hierarchy.held.resize(hierarchy.nodes.size());
  hierarchy.of_segments = threshold_ > 0;
  for (std::size_t at = 0; at < order_.size();) {
    const std::uint32_t node = first_node_[at];
    const auto begin = static_cast<std::uint32_t>(hierarchy.elements.size());
    for (; at < order_.size() && first_node_[at] == node; ++at)
      add_pieces(items_.elements[order_[at]], order_[at], node, hierarchy);
    hierarchy.held[node].begin = begin;
  }
  for (std::size_t i = hierarchy.nodes.size(); i-- > 0;)
    if (const HierarchyNode& node = hierarchy.nodes[i]; !node.is_leaf())
      hierarchy.held[i] = {hierarchy.held[i + 1].begin, hierarchy.held[node.second_child].end};
}

/// A piece's midpoint is its disc's centre.
void HierarchyBuilder::add_pieces(const Element& piece, std::uint32_t source, std::uint32_t node,
                                  Hierarchy& hierarchy) const {
  if (const std::uint32_t second = hierarchy.nodes[node].second_child; second != 0) {
    const Disc& disc = hierarchy.nodes[node].disc;
    const Vec2 middle{disc.x, disc.y};
    add_pieces({piece.a, middle, middle}, source, node + 1, hierarchy);
    return add_pieces({middle, piece.b, piece.b}, source, second, hierarchy);
  }
  const auto begin = static_cast<std::uint32_t>(hierarchy.elements.size());
  hierarchy.elements.push_back(piece);
  hierarchy.source.push_back(source);
  hierarchy.held[node] = {begin, begin + 1};
}

}  // namespace bch
