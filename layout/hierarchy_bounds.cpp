// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/hierarchy_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "layout/rounding.hpp"

namespace bch {
namespace {

/// Parents and subtrees' ends. Backwards and without branches: what a leaf writes for a first child that it
/// does not have is overwritten by the node's true parent, which stands further ahead.
void link(HierarchyArrays& arrays, std::uint32_t count) {
  auto& parent = arrays.parent;
  for (std::uint32_t i = count; i-- > 0;) {
    const std::uint32_t second = arrays.second_child[i];
    parent[i + 1] = i;
    parent[second] = i;
    arrays.end[i] = second == 0 ? i + 1 : arrays.end[second];
  }
  // One past the last node stands above the root.
  parent[0] = parent[count] = count;
  arrays.centre[count] = arrays.centre[0];
}

float square_distance(Vec2 a, Vec2 b) {
  const float x = b.x - a.x, y = b.y - a.y;
  return x * x + y * y;
}

/// In a loop of its own, which compilers vectorise.
template <class Value>
void take_roots(Value* values, std::uint32_t count) {
  for (std::uint32_t i = 0; i < count; ++i) values[i] = std::sqrt(values[i]);
}

/// Children's discs and grandchildren's bounds: a bound grows by 0.3 % over the tightest, where children's
/// bounds alone would make it 2 %. Each step rounds outward: its terms in float are off by 5 u.
void set_bounds(HierarchyArrays& arrays, std::uint32_t count) {
  constexpr float outward = 1 + 0x1p-21f;
  auto& [centre, square, second, begin, radius, bound, to_parent, to_grandparent, end, parent] = arrays;
  for (std::uint32_t i = 0; i < count; ++i) {
    to_parent[i] = square_distance(centre[i], centre[parent[i]]);
    to_grandparent[i] = square_distance(centre[i], centre[parent[parent[i]]]);
  }
  take_roots(to_parent.data(), count);
  take_roots(to_grandparent.data(), count);
  std::copy_n(radius.begin(), count, bound.begin());
  bound[count] = 0;
  const auto raise = [&](std::uint32_t node, float needed) {
    bound[node] = std::max(bound[node], needed * outward);
  };
  for (std::uint32_t i = count; i-- > 0;) {
    raise(parent[i], to_parent[i] + radius[i]);
    raise(parent[parent[i]], to_grandparent[i] + bound[i]);
  }
}

}  // namespace

void HierarchyArrays::resize(std::size_t nodes) {
  centre.resize(nodes), square_radius.resize(nodes), second_child.resize(nodes), element_begin.resize(nodes);
  radius.resize(nodes), bound.resize(nodes), to_parent.resize(nodes), to_grandparent.resize(nodes);
  end.resize(nodes), parent.resize(nodes);
}

void publish_nodes(HierarchyArrays& arrays, std::uint32_t count, double margin, Hierarchy& hierarchy) {
  if (arrays.centre.size() == count) arrays.resize(count + 1);
  take_roots(arrays.square_radius.data(), count);
  for (std::uint32_t i = 0; i < count; ++i)
    arrays.radius[i] = rounding::round_up(arrays.square_radius[i] * (1 + 0x1p-50) + margin);
  link(arrays, count);
  set_bounds(arrays, count);
  arrays.element_begin[count] = static_cast<std::uint32_t>(hierarchy.elements.size());
  const double slack = rounding::nesting_margin * hierarchy.reach;
  hierarchy.nodes.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const float radius = arrays.radius[i];
    const float bound = rounding::round_up(static_cast<double>(arrays.bound[i]) + slack);
    // A leaf prunes nothing: its bound is its disc, so that a traversal may test bounds throughout.
    const std::uint32_t second = arrays.second_child[i];
    hierarchy.nodes[i] = {{arrays.centre[i].x, arrays.centre[i].y, radius},
                          second == 0 ? radius : bound,
                          second,
                          arrays.element_begin[i],
                          arrays.element_begin[arrays.end[i]]};
  }
}

}  // namespace bch
