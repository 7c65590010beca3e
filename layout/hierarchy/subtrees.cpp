// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/hierarchy/subtrees.hpp"

#include <algorithm>
#include <cmath>

#include "layout/base/rounding.hpp"

namespace bch::detail {

std::vector<float> bounding_radii(const Hierarchy& hierarchy) {
  const auto& nodes = hierarchy.nodes;
  const std::vector<std::uint32_t> ends = subtree_ends(nodes);
  std::vector<float> bounds;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Disc& disc = nodes[i].disc;
    double held = disc.radius;
    for (std::size_t below = i + 1; below < ends[i]; ++below) {
      const Disc& other = nodes[below].disc;
      const double x = static_cast<double>(other.x) - static_cast<double>(disc.x),
                   y = static_cast<double>(other.y) - static_cast<double>(disc.y);
      held = std::max(held, (std::sqrt(x * x + y * y) + static_cast<double>(other.radius)) * (1 + 0x1p-50));
    }
    bounds.push_back(rounding::round_up(held));
  }
  return bounds;
}

std::vector<std::uint32_t> subtree_ends(std::span<const Hierarchy::Node> nodes) {
  std::vector<std::uint32_t> end(nodes.size());
  for (std::size_t i = nodes.size(); i-- > 0;)
    end[i] = nodes[i].is_leaf() ? static_cast<std::uint32_t>(i + 1) : end[nodes[i].second_child];
  return end;
}

}  // namespace bch::detail
