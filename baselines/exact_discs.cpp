// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/exact_discs.hpp"

#include <algorithm>

namespace bch::baselines {

ExactDisc tight_disc(const Hierarchy& hierarchy, std::uint32_t node) {
  const Disc& disc = hierarchy.nodes[node].disc;
  const auto [begin, end] = hierarchy.held.at(node);
  const QuadVector centre{disc.x, disc.y};
  Quad farthest = 0;
  for (std::uint32_t i = begin; i < end; ++i) {
    const Element& element = hierarchy.elements[i];
    for (const Vec2 p : {element.a, element.b, element.c})
      farthest = std::max(farthest, square(QuadVector{p.x, p.y} - centre));
  }
  return {centre, square_root(farthest)};
}

std::vector<ExactDisc> tight_discs(const Hierarchy& hierarchy, std::uint32_t depth) {
  std::vector<ExactDisc> discs;
  for (const std::uint32_t node : cut(hierarchy, depth)) discs.push_back(tight_disc(hierarchy, node));
  return discs;
}

}  // namespace bch::baselines
