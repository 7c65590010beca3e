// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include <bch/hierarchy.hpp>

#include "baselines/disc_tree.hpp"
#include "baselines/kind_rows.hpp"
#include "baselines/nested_contours.hpp"
#include "baselines/placement.hpp"
#include "baselines/segment_lists.hpp"
#include "baselines/traversal_stack.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"

// The kinds "reference", "reference_segments" and "paper_descent": the paper's descent of two binary trees by their
// smallest discs, one pair at a time, into the larger disc first. The batch kernel's speed is measured against the first
// two, so all are written to be fast. "reference" verifies what the descent finds, because that meets some pairs of
// ancestors and not all. "reference_segments" has exact leaves and counts containment, as collide() does.

namespace bch::baselines {
namespace {

/// A node as the traversal reads it: 16 bytes, a quarter of a cache line.
struct Node {
  float x, y, radius;
  std::uint32_t second_child;  ///< among all shapes' nodes; the first child is the next node; 0: a leaf

  bool is_leaf() const noexcept { return second_child == 0; }
};
static_assert(sizeof(Node) == 16);

struct Centre {
  float x, y;
};

/// Places a disc of B as discs_overlap() does. The result is kept with B's node while the traversal
/// descends on A's side.
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
  std::uint32_t left_a, left_b;  ///< levels that are yet to be descended; at 0 a node counts as a leaf
  Centre centre_b;
};

/// What makes a hit of two leaves whose discs overlap.
enum class HitBy : std::uint8_t {
  descent,    ///< nothing else
  ancestors,  ///< all discs above them overlap
  segments,   ///< the same, and their segments meet; at nodes above the leaves, ancestors alone
};

/// Tests both children before it goes on with one of them: their tests do not wait for each other, and fewer
/// branches are mispredicted than by a stack of pairs yet to be tested. True as soon as accept(visit) is true
/// of two leaves whose discs overlap.
/// Precondition: `open` has room for the sum of the trees' heights.
template <class Counts, class Accept>
bool any_leaves_overlap(const Node* nodes, Visit at, const FloatPlacement& place, Visit* open, Counts counts,
                        Accept accept) noexcept {
  counts.node();
  if (!overlap(nodes[at.a], at.centre_b, nodes[at.b].radius)) return false;
  const Visit* const bottom = open;
  for (;;) {
    const Node &a = nodes[at.a], &b = nodes[at.b];
    const bool end_a = a.is_leaf() || at.left_a == 0, end_b = b.is_leaf() || at.left_b == 0;
    Visit first = at, second = at;
    bool first_hit = false, second_hit = false;
    if (end_a && end_b) {
      if (accept(at)) return true;
    } else if (end_b || (!end_a && a.radius >= b.radius)) {
      first.a = at.a + 1;
      second.a = a.second_child;
      first.left_a = second.left_a = at.left_a - 1;
      first_hit = overlap(nodes[first.a], at.centre_b, b.radius);
      second_hit = overlap(nodes[second.a], at.centre_b, b.radius);
      counts.node(), counts.node();
    } else {
      first.b = at.b + 1;
      second.b = b.second_child;
      first.left_b = second.left_b = at.left_b - 1;
      first.centre_b = placed(place, nodes[first.b]);
      second.centre_b = placed(place, nodes[second.b]);
      first_hit = overlap(a, first.centre_b, nodes[first.b].radius);
      second_hit = overlap(a, second.centre_b, nodes[second.b].radius);
      counts.node(), counts.node();
    }
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

/// Returns whether all nodes from the root of A down to `a` overlap all nodes from the root of B down to `b`.
/// The paths follow from the order of nodes, so pairs without a hit pay nothing for them. (To store parents
/// gained 10 ns of 590.)
/// Precondition: `path` has room for the height of A and one more.
template <class Counts>
bool ancestors_overlap(const Node* nodes, Pair roots, std::uint32_t a, std::uint32_t b,
                       const FloatPlacement& place, Node* path, Counts counts) noexcept {
  Node* end = path;
  for (std::uint32_t at = roots.first; at != a; at = towards(nodes, at, a)) *end++ = nodes[at];
  *end++ = nodes[a];
  for (std::uint32_t at = roots.second;; at = towards(nodes, at, b)) {
    const Centre centre = placed(place, nodes[at]);
    for (const Node* above = path; above != end; ++above) {
      counts.ancestor();
      if (!overlap(*above, centre, nodes[at].radius)) return false;
    }
    if (at == b) return true;
  }
}

class ContourHierarchies final : public Structure {
 public:
  explicit ContourHierarchies(HitBy hit_by) : hit_by_(hit_by) {}

  void add(const Shape& shape) {
    const Hierarchy& hierarchy = shape.hierarchy;
    const auto root = static_cast<std::uint32_t>(nodes_.size());
    for (const auto& [disc, second] : hierarchy.nodes)
      nodes_.push_back({disc.x, disc.y, disc.radius, second == 0 ? 0 : root + second});
    roots_.push_back(root);
    sizes_.push_back(hierarchy.nodes.size());
    highest_ = std::max(highest_, std::size_t{detail::height(hierarchy)});
    if (hit_by_ != HitBy::segments) return;
    segments_.add(shape);
    contours_.add(shape.outline);
  }

  bool query(const Agents& agents, Pair pair, std::uint32_t max_depth) const override {
    TraversalScratch scratch(highest_);
    return meet(agents, pair, max_depth, scratch, NoCounts{});
  }
  bool query(const Agents& agents, Pair pair, std::uint32_t max_depth, TestCounts& counts) const override {
    TraversalScratch scratch(highest_);
    return meet(agents, pair, max_depth, scratch, AddCounts{counts});
  }
  std::size_t bytes(std::uint32_t shape) const override {
    const std::size_t nodes = sizes_.at(shape) * sizeof(Node);
    return hit_by_ == HitBy::segments ? nodes + segments_.bytes(shape) : nodes;
  }
  std::uint32_t shape_count() const override { return static_cast<std::uint32_t>(roots_.size()); }

 private:
  struct TraversalScratch {
    explicit TraversalScratch(std::size_t height) : open(2 * height + 1), path(height + 1) {}
    Scratch<Visit> open;
    Scratch<Node> path;
  };

  void answer(const Agents& agents, std::span<const Pair> pairs, std::span<std::uint8_t> hits,
              std::uint32_t max_depth) const override {
    TraversalScratch scratch(highest_);
    for (std::size_t i = 0; i < pairs.size(); ++i)
      hits[i] = meet(agents, pairs[i], max_depth, scratch, NoCounts{}) ? 1 : 0;
  }

  template <class Counts>
  bool meet(const Agents& agents, Pair pair, std::uint32_t max_depth, TraversalScratch& scratch,
            Counts counts) const {
    const auto [first, second] = std::minmax(pair.first, pair.second);
    const Pair roots{roots_[agents.shape[first]], roots_[agents.shape[second]]};
    const FloatPlacement place = float_placement(agents, pair);
    const Node* const nodes = nodes_.data();
    const Visit start{roots.first, roots.second, max_depth, max_depth, placed(place, nodes[roots.second])};
    const auto verified = [&](const Visit& at) {
      return ancestors_overlap(nodes, roots, at.a, at.b, place, scratch.path.data(), counts);
    };
    const auto search = [&](auto accept) {
      return any_leaves_overlap(nodes, start, place, scratch.open.data(), counts, accept);
    };
    if (hit_by_ == HitBy::descent) return search([](const Visit&) { return true; });
    if (hit_by_ == HitBy::ancestors) return search(verified);
    const double margin = segments_.margin(agents.shape[first], agents.shape[second]);
    return search([&](const Visit& at) {
             if (margin < 0 || at.left_a == 0 || at.left_b == 0) return verified(at);
             const Meeting found = segments_.closest(place, margin, at.a, at.b, counts);
             return found == Meeting::sure || (found == Meeting::within_margin && verified(at));
           }) ||
           contours_.query(agents, pair, place);
  }

  HitBy hit_by_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> roots_;  ///< per shape
  std::vector<std::size_t> sizes_;    ///< per shape: nodes
  SegmentLists segments_;             ///< for HitBy::segments, as the contours
  NestedContours contours_;
  std::size_t highest_ = 0;
};

std::unique_ptr<Structure> build(std::span<const Body> bodies, HitBy hit_by) {
  auto all = std::make_unique<ContourHierarchies>(hit_by);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].shape.hierarchy.nodes.empty())
      throw std::invalid_argument("body " + std::to_string(i) + ": a hierarchy without nodes");
    all->add(bodies[i].shape);
  }
  return all;
}

}  // namespace

std::unique_ptr<Structure> build_reference(std::span<const Body> bodies, const BuildOptions&) {
  return build(bodies, HitBy::ancestors);
}

std::unique_ptr<Structure> build_reference_segments(std::span<const Body> bodies, const BuildOptions&) {
  return build(bodies, HitBy::segments);
}

std::unique_ptr<Structure> build_paper_descent(std::span<const Body> bodies, const BuildOptions&) {
  return build(bodies, HitBy::descent);
}

}  // namespace bch::baselines
