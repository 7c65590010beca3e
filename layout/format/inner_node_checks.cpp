// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "layout/base/rounding.hpp"
#include "layout/format/cut_discs.hpp"
#include "layout/format/shape_checks.hpp"

// Inner nodes: that their links make a tree, so that every path up ends at the root; and that their discs are no larger than
// what lies below them needs, which bounds the time of a pair.

namespace bch::detail::shape_checks {
namespace {

/// A level's inner nodes and discs.
class InnerNodes {
 public:
  InnerNodes(const ShapeArrays& a, const LevelNodes& level)
      : nodes_(a.nodes.data()), tree_(a.trees[level.root]), first_(tree_.first_inner()) {}

  std::uint32_t count() const { return tree_.count - 1; }
  std::uint32_t number(std::uint32_t k) const { return first_ + k; }
  std::uint32_t link(std::uint32_t k) const { return std::bit_cast<std::uint32_t>(record(k)[3]); }
  /// The index of the node above, or anything.
  std::uint32_t above(std::uint32_t k) const { return (link(k) & ~parent_of_cut_disc) - first_; }
  bool is_above_disc(std::uint32_t k) const { return link(k) >= parent_of_cut_disc; }
  Disc inner(std::uint32_t k) const { return {record(k)[0], record(k)[1], record(k)[2]}; }
  Disc cut(std::uint32_t k) const {
    const float* x = nodes_ + tree_.discs + k;
    return {x[0], x[tree_.stride], x[2 * std::size_t{tree_.stride}]};
  }

 private:
  const float* record(std::uint32_t k) const { return nodes_ + std::size_t{first_ + k} * inner_floats; }

  const float* nodes_;
  Tree tree_;
  std::uint32_t first_;
};

[[noreturn]] void reject_inner(const InnerNodes& nodes, std::uint32_t k, const char* what) {
  reject("nodes", std::size_t{nodes.number(k)} * inner_floats, what);
}

/// Requires a node's disc to be no larger than the smallest one about those of its children, but for rounding: that has the
/// larger one's radius, or half of the distance of their far ends.
void require_needed(const InnerNodes& nodes, std::uint32_t k, const Disc& first, const Disc& second,
                    float slack) {
  const float radius = nodes.inner(k).radius * (1 - 0x1p-18f) - slack;
  const float x = second.x - first.x, y = second.y - first.y;
  const float rest = 2 * radius - (first.radius + second.radius);
  if (radius > std::max(first.radius, second.radius) && rest > 0 && rest * rest > x * x + y * y)
    reject_inner(nodes, k, "an inner node is larger than what is below it needs");
}

bool same(const Disc& a, const Disc& b) {
  return a.x == b.x && a.y == b.y && a.radius == b.radius;
}

/// The open nodes on the way from the root to the last node visited: those that have no node above them yet
/// but the one before in this list. A node whose first child is not a disc of the cut ends the part of the
/// list that is below it. So each node is taken from the list once, and the one above it later. All ways end
/// at the last one, the root.
class PendingNodes {
 public:
  PendingNodes(const InnerNodes& nodes, std::vector<LevelNodes::OpenNode>& open, float slack)
      : nodes_(nodes), open_(open), slack_(slack) {
    open_.clear();
  }

  void add(std::uint32_t k) {
    const Disc first = nodes_.is_above_disc(k) ? nodes_.cut(k) : end_first_child(k);
    open_.push_back({k, first});
  }

  /// Returns: the root.
  std::uint32_t end_all(std::uint32_t last_disc) {
    Disc second = nodes_.cut(last_disc);
    for (;;) {
      const std::uint32_t k = take_last(second);
      if (open_.empty() && nodes_.above(k) == k) return k;
      require_below_last(k);
      second = nodes_.inner(k);
    }
  }

 private:
  /// Returns: the disc of the first child.
  Disc end_first_child(std::uint32_t k) {
    for (Disc second = nodes_.cut(k);;) {
      if (open_.empty()) reject_inner(nodes_, k, "an inner node has no first child");
      const std::uint32_t below = take_last(second);
      if (nodes_.above(below) == k) return nodes_.inner(below);
      require_below_last(below);
      second = nodes_.inner(below);
    }
  }

  std::uint32_t take_last(const Disc& second) {
    const auto [k, first] = open_.back();
    open_.pop_back();
    require_needed(nodes_, k, first, second, slack_);
    return k;
  }

  void require_below_last(std::uint32_t k) const {
    if (open_.empty() || nodes_.above(k) != open_.back().node)
      reject_inner(nodes_, k, "an inner node is not below the one that it names");
  }

  const InnerNodes& nodes_;
  std::vector<LevelNodes::OpenNode>& open_;
  const float slack_;
};

/// One past the last of the discs that are shown below a node.
std::uint32_t end_of_discs(const float* nodes, std::uint32_t node) {
  while (node < leaf_bit) {
    std::uint32_t lane = block_width - 1;
    while (lane > 0 && nodes[node + lane] == infinity) --lane;
    node = std::bit_cast<std::uint32_t>(nodes[node + block_names + lane]);
  }
  return (node & ~leaf_bit) + block_width;
}

}  // namespace

void inner_nodes(const ShapeArrays& a, LevelNodes& level) {
  const InnerNodes nodes(a, level);
  const Root& root = a.roots[level.root];
  if (nodes.count() == 0) {
    if (!nodes.is_above_disc(0) || nodes.above(0) != 0 || !same(nodes.inner(0), nodes.cut(0)))
      reject_inner(nodes, 0, "the only node is not the cut's disc");
    return;
  }
  const auto slack = static_cast<float>(rounding::conservative_margin + 49 * rounding::unit_roundoff);
  PendingNodes open(nodes, level.open_nodes, slack * a.max_extent[level.root / a.depths.size()]);
  for (std::uint32_t k = 0; k < nodes.count(); ++k) open.add(k);
  if (nodes.is_above_disc(nodes.count())) reject_inner(nodes, nodes.count(), "padding is above a disc");
  const std::uint32_t top = open.end_all(nodes.count());
  if (!same(nodes.inner(top), {root.x, root.y, root.radius}))
    reject("roots", level.root, "not its tree's root");
}

/// A node is the lowest one above two neighbours among the discs, and no other node is so above these: where they are shown
/// below it, it is not far above them.
void nodes_of_blocks(const ShapeArrays& a, LevelNodes& level) {
  const Tree& tree = a.trees[level.root];
  const InnerNodes nodes(a, level);
  const float* floats = a.nodes.data();
  if (tree.top >= leaf_bit) return;
  for (std::uint64_t block = tree.top; block < level.discs; block += block_floats)
    for (std::uint32_t lane = 0; lane < block_width && floats[block + lane] < infinity; ++lane) {
      const auto bits = [&](std::uint32_t field) {
        return std::bit_cast<std::uint32_t>(floats[block + field + lane]);
      };
      const std::uint32_t child = bits(block_names), node = bits(block_nodes);
      const std::uint32_t first = first_disc(floats, child) - tree.discs,
                          last = end_of_discs(floats, child) - 1 - tree.discs;
      const bool is_disc = node >= leaf_bit;
      const std::uint32_t k = is_disc ? (node & ~leaf_bit) - tree.discs : node - nodes.number(0);
      const Disc disc{floats[block + lane], floats[block + block_width + lane],
                      floats[block + 2 * block_width + lane]};
      if (k < first || k > last || k > nodes.count() || (!is_disc && k >= std::min(last, nodes.count())) ||
          !same(disc, is_disc ? nodes.cut(k) : nodes.inner(k)))
        reject("nodes", block, "disc " + std::to_string(lane) + " is not a node above those below it");
    }
}

/// Nearest discs are pruned by them. A smallest disc's centre is inside of every disc about all of what it holds.
void outer_radii(const ShapeArrays& a, LevelNodes& level) {
  const Tree& tree = a.trees[level.root];
  const float* floats = a.nodes.data();
  const float* radii = floats + tree.discs + 2 * std::size_t{tree.stride};
  const float most = 2 * *std::max_element(radii, radii + tree.count);
  const auto good = [&](float outer, float radius) { return outer >= 0 && outer <= radius + most; };
  if (!good(tree.outer_radius, a.roots[level.root].radius))
    reject("trees", level.root, "expected a finite outer radius, found another");
  if (tree.top >= leaf_bit) return;
  for (std::uint64_t block = tree.top; block < level.discs; block += block_floats)
    for (std::uint32_t lane = 0; lane < block_width && floats[block + lane] < infinity; ++lane)
      if (!good(floats[block + block_outer + lane], floats[block + 2 * block_width + lane]))
        reject("nodes", block,
               "expected a finite outer radius of disc " + std::to_string(lane) + ", found another");
}

}  // namespace bch::detail::shape_checks
