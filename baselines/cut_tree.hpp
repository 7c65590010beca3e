// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <bch/agents.hpp>
#include <bch/shapes.hpp>

#include "baselines/placement.hpp"

namespace bch::baselines {

/// Holds the cuts of shapes as binary trees of their own, level by level as in a ShapeSet. The scalar
/// references of the queries about distances and times search them.
class CutTrees {
 public:
  /// Represents a node, 16 bytes. Inner ones have the radius that holds all discs below.
  struct Node {
    float x, y, radius;
    std::uint32_t
        link;  ///< inner: the second child, the first one being the next node; leaf: is_leaf + its index

    static constexpr std::uint32_t is_leaf = 0x80000000;
    bool leaf() const noexcept { return link >= is_leaf; }
    std::uint32_t index() const noexcept { return link & ~is_leaf; }
  };
  struct Tree {
    std::vector<Node> nodes;
    std::vector<Disc> discs;  ///< of the cut, in its order
    float max_extent;
  };

  CutTrees(std::span<const Shape> shapes, const ShapeSetPlan& plan);

  const Tree& tree(const Agents& agents, std::uint32_t agent) const;

 private:
  std::uint32_t level_count_;
  std::vector<Tree> trees_;  ///< shape * level_count_ + level
};

/// Returns the step from a disc of A to one of B, in A's frame, computed as layout/base/rounding.hpp lists
/// it.
struct Step {
  float x, y, radius_sum;
};

template <class DiscA, class DiscB>
Step step(const FloatPlacement& place, const DiscA& a, const DiscB& b) noexcept {
  return {place.x + (place.cosine * b.x - place.sine * b.y) - a.x,
          place.y + (place.sine * b.x + place.cosine * b.y) - a.y, a.radius + b.radius};
}

/// Walks both trees, the nearer child first: visit(a, b, step) for pairs of leaves, leaving out what lies
/// below pairs for which bound(step) is above best(). Bounds and best are of one measure; `open` is scratch.
struct OpenPair {
  std::uint32_t a, b;
  float bound;
};
template <class Bound, class Best, class Visit>
void search(const FloatPlacement& place, const CutTrees::Node* nodes_a, const CutTrees::Node* nodes_b,
            std::vector<OpenPair>& open, Bound bound, Best best, Visit visit) {
  open.clear();
  open.push_back({0, 0, bound(step(place, nodes_a[0], nodes_b[0]))});
  while (!open.empty()) {
    const OpenPair at = open.back();
    open.pop_back();
    if (at.bound > best()) continue;
    const CutTrees::Node &a = nodes_a[at.a], &b = nodes_b[at.b];
    if (a.leaf() && b.leaf()) {
      visit(a.index(), b.index(), step(place, a, b));
      continue;
    }
    const bool split_a = b.leaf() || (!a.leaf() && a.radius >= b.radius);
    OpenPair near = split_a ? OpenPair{at.a + 1, at.b, 0} : OpenPair{at.a, at.b + 1, 0};
    OpenPair far = split_a ? OpenPair{a.link, at.b, 0} : OpenPair{at.a, b.link, 0};
    near.bound = bound(step(place, nodes_a[near.a], nodes_b[near.b]));
    far.bound = bound(step(place, nodes_a[far.a], nodes_b[far.b]));
    if (far.bound < near.bound) std::swap(near, far);
    if (far.bound <= best()) open.push_back(far);
    if (near.bound <= best()) open.push_back(near);
  }
}

}  // namespace bch::baselines
