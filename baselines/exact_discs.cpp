// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/exact_discs.hpp"

#include <algorithm>

namespace bch::baselines {

namespace {

/// Calls visit(point) for all points of what a node holds.
template <class Visit>
void visit_content(const Hierarchy& hierarchy, std::uint32_t node, Visit visit) {
  const auto [begin, end] = hierarchy.primitive_ranges.at(node);
  for (std::uint32_t i = begin; i < end; ++i) {
    const Hierarchy::Primitive& primitive = hierarchy.primitives[i];
    for (const Vec2 p : {primitive.a, primitive.b, primitive.c}) visit(p);
  }
}

double square_in_double(Vec2 p, const Disc& from) {
  const double x = static_cast<double>(p.x) - static_cast<double>(from.x),
               y = static_cast<double>(p.y) - static_cast<double>(from.y);
  return x * x + y * y;
}

}  // namespace

ExactDisc tight_disc(const Hierarchy& hierarchy, std::uint32_t node) {
  const Disc& disc = hierarchy.nodes[node].disc;
  const QuadVector centre{disc.x, disc.y};
  // Only what double may mistake for the farthest is examined slowly.
  double rough = 0;
  visit_content(hierarchy, node, [&](Vec2 p) { rough = std::max(rough, square_in_double(p, disc)); });
  Quad farthest = 0;
  visit_content(hierarchy, node, [&](Vec2 p) {
    if (square_in_double(p, disc) >= (1 - 1e-14) * rough)
      farthest = std::max(farthest, square(QuadVector{p.x, p.y} - centre));
  });
  return {centre, square_root(farthest)};
}

ExactCut ExactCut::posed(QuadVector rotation) const {
  ExactCut turned = *this;
  for (ExactDisc& disc : turned.discs) disc = disc.posed(rotation);
  return turned;
}

std::vector<std::uint32_t> ExactCut::path(std::uint32_t disc) const {
  std::vector<std::uint32_t> discs_above = {disc};
  while (discs_above.back() != 0) discs_above.push_back(above[discs_above.back()]);
  return discs_above;
}

ExactCut exact_cut(const Hierarchy& hierarchy, std::uint32_t depth) {
  struct Open {
    std::uint32_t node, depth, above;
  };
  ExactCut result;
  std::vector<Open> open = {{0, 0, 0}};
  while (!open.empty()) {
    const Open at = open.back();
    open.pop_back();
    const auto number = static_cast<std::uint32_t>(result.discs.size());
    result.discs.push_back(tight_disc(hierarchy, at.node));
    result.above.push_back(at.above);
    const Hierarchy::Node& node = hierarchy.nodes[at.node];
    if (node.is_leaf() || at.depth == depth) {
      result.cut.push_back(number);
      continue;
    }
    open.push_back({node.second_child, at.depth + 1, number});
    open.push_back({at.node + 1, at.depth + 1, number});
  }
  return result;
}

}  // namespace bch::baselines
