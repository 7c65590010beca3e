// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "baselines/disc_tree.hpp"
#include "baselines/kind_rows.hpp"

// The kind "reference": what the batch kernel's speed is measured against, so written to be fast. Plain
// depth-first traversal of two binary trees, one pair at a time, descending into the larger disc.

namespace bch::baselines {
namespace {

/// A node as the whole traversal reads it: 16 bytes, a quarter of a cache line. Inner nodes have the radius
/// that holds all discs below.
struct Node {
  float x, y, radius;
  std::uint32_t second_child;  ///< among all shapes' nodes; the first child is the next node; 0: a leaf

  bool is_leaf() const noexcept { return second_child == 0; }
};
static_assert(sizeof(Node) == 16);

struct Centre {
  float x, y;
};

/// As discs_overlap() places a disc of B; kept beside B's node while A's side descends.
Centre placed(const FloatPlacement& place, const Node& b) noexcept {
  return {place.x + (place.cosine * b.x - place.sine * b.y),
          place.y + (place.sine * b.x + place.cosine * b.y)};
}

bool overlap(const Node& a, Centre b, float radius_b) noexcept {
  const float x = b.x - a.x, y = b.y - a.y, radius_sum = a.radius + radius_b;
  return x * x + y * y <= radius_sum * radius_sum;
}

struct Visit {
  std::uint32_t a, b;
  Centre centre_b;
};

/// Tests both children before it goes on with one of them: their tests do not wait for each other, and fewer
/// branches are mispredicted than by a stack of pairs yet to be tested. Kept centres and that took 617, 418
/// and 503 ns to 430, 253 and 311 (colliding, near miss, crowd).
/// Precondition: `open` has room for the sum of the trees' heights.
template <class Counts>
bool leaves_overlap(const Node* nodes, std::uint32_t root_a, std::uint32_t root_b,
                    const FloatPlacement& place, Visit* open, Counts counts) noexcept {
  Visit at{root_a, root_b, placed(place, nodes[root_b])};
  counts.node();
  if (!overlap(nodes[at.a], at.centre_b, nodes[at.b].radius)) return false;
  const Visit* const bottom = open;
  for (;;) {
    const Node &a = nodes[at.a], &b = nodes[at.b];
    if (a.is_leaf() && b.is_leaf()) return true;
    Visit first = at, second = at;
    bool first_hit, second_hit;
    if (b.is_leaf() || (!a.is_leaf() && a.radius >= b.radius)) {
      first.a = at.a + 1;
      second.a = a.second_child;
      first_hit = overlap(nodes[first.a], at.centre_b, b.radius);
      second_hit = overlap(nodes[second.a], at.centre_b, b.radius);
    } else {
      first.b = at.b + 1;
      second.b = b.second_child;
      first.centre_b = placed(place, nodes[first.b]);
      second.centre_b = placed(place, nodes[second.b]);
      first_hit = overlap(a, first.centre_b, nodes[first.b].radius);
      second_hit = overlap(a, second.centre_b, nodes[second.b].radius);
    }
    counts.node();
    counts.node();
    if (first_hit) {
      *open = second;
      open += second_hit;
      at = first;
    } else if (second_hit) {
      at = second;
    } else if (open == bottom) {
      return false;
    } else {
      at = *--open;
    }
  }
}

class ContourHierarchies final : public Structure {
 public:
  void add(const Hierarchy& hierarchy) {
    const auto root = static_cast<std::uint32_t>(nodes_.size());
    std::vector<float> bounds = bounding_radii(hierarchy);
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      const auto& [disc, second] = hierarchy.nodes[i];
      nodes_.push_back({disc.x, disc.y, bounds[i], second == 0 ? 0 : root + second});
    }
    trees_.push_back({root, height(hierarchy), hierarchy.nodes, std::move(bounds)});
    highest_ = std::max(highest_, trees_.back().height);
  }

  bool query(const Agents& agents, Pair pair, std::uint32_t max_depth) const override {
    Stack stack(highest_);
    return meet(agents, pair, max_depth, stack, NoCounts{});
  }
  bool query(const Agents& agents, Pair pair, std::uint32_t max_depth, TestCounts& counts) const override {
    Stack stack(highest_);
    return meet(agents, pair, max_depth, stack, AddCounts{counts});
  }
  /// What queries at all depths read.
  std::size_t bytes(std::uint32_t shape) const override {
    return trees_.at(shape).nodes.size() * sizeof(Node);
  }
  std::uint32_t shape_count() const override { return static_cast<std::uint32_t>(trees_.size()); }

 private:
  struct Tree {
    std::uint32_t root;
    std::uint32_t height;
    std::vector<HierarchyNode> nodes;  ///< for queries that end at a depth, which need the tight discs too
    std::vector<float> bounds;
  };

  /// On the caller's stack, except for trees of absurd heights.
  class Stack {
   public:
    explicit Stack(std::uint32_t height) {
      if (2 * std::size_t{height} >= most_inside) heap_.resize(2 * std::size_t{height} + 1);
    }
    Visit* bottom() noexcept { return heap_.empty() ? inside_ : heap_.data(); }

   private:
    static constexpr std::size_t most_inside = 128;
    Visit inside_[most_inside];  // not initialised: a query of one pair would notice
    std::vector<Visit> heap_;
  };

  void answer(const Agents& agents, std::span<const Pair> pairs, std::span<std::uint8_t> hits,
              std::uint32_t max_depth) const override {
    Stack stack(highest_);
    for (std::size_t i = 0; i < pairs.size(); ++i)
      hits[i] = meet(agents, pairs[i], max_depth, stack, NoCounts{}) ? 1 : 0;
  }

  template <class Counts>
  bool meet(const Agents& agents, Pair pair, std::uint32_t max_depth, Stack& stack, Counts counts) const {
    const auto [first, second] = std::minmax(pair.first, pair.second);
    const Tree &a = trees_[agents.shape[first]], &b = trees_[agents.shape[second]];
    const FloatPlacement place = float_placement(agents, pair);
    if (max_depth == all_depths)
      return leaves_overlap(nodes_.data(), a.root, b.root, place, stack.bottom(), counts);
    return any_ends_overlap(place, {a.nodes.data(), a.bounds.data(), max_depth, a.height},
                            {b.nodes.data(), b.bounds.data(), max_depth, b.height}, counts,
                            [](const NodePair&) { return true; });
  }

  std::vector<Node> nodes_;
  std::vector<Tree> trees_;
  std::uint32_t highest_ = 0;
};

}  // namespace

std::unique_ptr<Structure> build_reference(std::span<const Body> bodies, const BuildOptions&) {
  auto all = std::make_unique<ContourHierarchies>();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Hierarchy& hierarchy = bodies[i].shape.hierarchy;
    if (hierarchy.nodes.empty())
      throw std::invalid_argument("body " + std::to_string(i) + ": a hierarchy without nodes");
    all->add(hierarchy);
  }
  return all;
}

}  // namespace bch::baselines
