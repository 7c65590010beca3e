// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/shape_set/chunk_level.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace bch::detail {
namespace {

/// Writes numbers of nodes on their way from a key to the next one, rounded as AnimatedTreeChunk::disc() does: a step is a power of two, so
/// that each product with it is exact. (Integers of 32 bits on the way, because no loop of a compiler goes from 16 bits to 64.)
template <class Number>
void blend(const Number* from, const Number* to, std::size_t count, double share, double step, float* out) {
  const double share_of_steps = share * step;
  for (std::size_t i = 0; i < count; ++i) {
    const int first = from[i], way = int{to[i]} - first;
    out[i] =
        static_cast<float>(static_cast<double>(first) * step + static_cast<double>(way) * share_of_steps);
  }
}

/// Adds room as rounding::round_up() rounds. What is left of the sum keeps its sign as a float, so that compilers vectorise this.
void add_room(float* radius, std::size_t count, double room) {
  for (std::size_t i = 0; i < count; ++i) {
    const double sum = double{radius[i]} + room;
    const float nearest = static_cast<float>(sum), left = static_cast<float>(sum - double{nearest});
    const auto bits = std::bit_cast<std::uint32_t>(nearest);
    radius[i] = std::bit_cast<float>(left > 0 ? bits + 1 : bits);
  }
}

/// Copies the discs of leaves, with padding where they are fewer than eight.
void take_leaves(const std::vector<float>& nodes, std::uint32_t first, std::uint32_t count, float padding,
                 std::vector<float>& leaves) {
  leaves.assign(nodes.begin() + first, nodes.begin() + first + count);
  leaves.resize(std::max(count, block_width), padding);
}

}  // namespace

ChunkLevel::ChunkLevel(const AnimatedTreeChunk& chunk) : chunk_(chunk), root_(below_only_children(0)) {
  inner_.resize(leaves() - 1);
  if (!chunk_.is_leaf(root_)) add_inner(root_, number(chunk_.children(root_)));
  if (leaves() > block_width) add_blocks();
}

std::uint32_t ChunkLevel::leaves_before(std::uint32_t node) const noexcept {
  while (!chunk_.is_leaf(node)) node = chunk_.children(node).begin;
  return node - chunk_.first_leaf();
}

/// Returns how many leaves there are up to the last one of a node.
std::uint32_t ChunkLevel::leaves_to(std::uint32_t node) const noexcept {
  while (!chunk_.is_leaf(node)) node = chunk_.children(node).end - 1;
  return node - chunk_.first_leaf() + 1;
}

/// Returns the node that holds what a node holds and is a leaf or falls apart.
std::uint32_t ChunkLevel::below_only_children(std::uint32_t node) const noexcept {
  while (!chunk_.is_leaf(node) && chunk_.children(node).end - chunk_.children(node).begin == 1)
    node = chunk_.children(node).begin;
  return node;
}

/// Returns the number of the binary tree's node that holds nodes.
std::uint32_t ChunkLevel::number(const NodeRange& nodes) const noexcept {
  return leaves_to(nodes.begin + (nodes.end - nodes.begin) / 2 - 1) - 1;
}

void ChunkLevel::add_inner(std::uint32_t node, std::uint32_t above) {
  node = below_only_children(node);
  if (!chunk_.is_leaf(node)) add_inner(chunk_.children(node), node, above);
}

void ChunkLevel::add_inner(const NodeRange& nodes, std::uint32_t of, std::uint32_t above) {
  if (nodes.end - nodes.begin == 1) return add_inner(nodes.begin, above);
  const std::uint32_t own = number(nodes), middle = nodes.begin + (nodes.end - nodes.begin) / 2;
  inner_[own] = {of, above | (own == leaves_before(nodes.begin) ? above_cut_disc : 0)};
  add_inner({nodes.begin, middle}, of, own);
  add_inner({middle, nodes.end}, of, own);
}

/// Level by level, as blocks are numbered.
void ChunkLevel::add_blocks() {
  std::vector<std::uint32_t> of_blocks = {root_};
  for (std::size_t i = 0; i < of_blocks.size(); ++i) {
    Block& block = blocks_.emplace_back();
    block.disc.fill(chunk_.nodes());
    const NodeRange children = chunk_.children(of_blocks[i]);
    for (std::uint32_t k = 0, child = children.begin; child < children.end; ++child, ++k) {
      const std::uint32_t node = below_only_children(child), first = leaves_before(node);
      block.disc[k] = node;
      block.node[k] = chunk_.is_leaf(node) ? leaf_window + first : number(chunk_.children(node));
      const bool is_window = leaves_to(node) - first <= block_width;
      block.child[k] = is_window ? leaf_window + std::min(first, leaves() - block_width)
                                 : static_cast<std::uint32_t>(of_blocks.size());
      if (!is_window) of_blocks.push_back(node);
    }
  }
}

void ChunkLevel::place_nodes(const KeyPlace& at, double reach, PlacedChunk& nodes) const {
  const std::uint32_t count = chunk_.nodes(), first_leaf = chunk_.first_leaf();
  for (std::vector<float>* const numbers : {&nodes.x, &nodes.y, &nodes.radius}) numbers->resize(count + 1);
  const NodesAtKey from = chunk_.key(at.key), to = chunk_.key(at.key + 1);
  blend(from.x, to.x, count, at.share, chunk_.step, nodes.x.data());
  blend(from.y, to.y, count, at.share, chunk_.step, nodes.y.data());
  blend(from.radius, to.radius, count, at.share, chunk_.step, nodes.radius.data());
  add_room(nodes.radius.data(), first_leaf, room_of_nodes * reach);
  add_room(nodes.radius.data() + first_leaf, count - first_leaf, room_of_leaves * reach);
  nodes.x.back() = std::numeric_limits<float>::infinity(), nodes.y.back() = nodes.radius.back() = 0;
  nodes.above_leaves.clear();
  for (std::uint32_t i = 0; i < first_leaf; ++i)
    nodes.above_leaves.push_back({nodes.x[i], nodes.y[i], nodes.radius[i], 0});
}

void ChunkLevel::place(const KeyPlace& at, double reach, PlacedChunk& nodes, Bvh8& level) const {
  place_nodes(at, reach, nodes);
  level.count = leaves();
  level.root = {nodes.x[root_], nodes.y[root_], nodes.radius[root_]};
  level.outer = level.root.radius;
  level.nodes_hold_discs = true;
  level.top = blocks_.empty() ? leaf_window : 0;
  const std::uint32_t first = chunk_.first_leaf();
  take_leaves(nodes.x, first, level.count, std::numeric_limits<float>::infinity(), level.x);
  take_leaves(nodes.y, first, level.count, 0, level.y);
  take_leaves(nodes.radius, first, level.count, 0, level.radius);
  place_inner(nodes, level);
  place_blocks(nodes, level);
}

void ChunkLevel::place_inner(const PlacedChunk& nodes, Bvh8& level) const {
  level.inner.resize(level.count);
  const auto& [x, y, radius] = level.root;
  level.inner.back() = level.is_single() ? InnerNode{x, y, radius, above_cut_disc} : InnerNode{};
  const InnerNode* const above_leaves = nodes.above_leaves.data();
  InnerNode* out = level.inner.data();
  for (const auto& [disc, link] : inner_) {
    *out = above_leaves[disc];
    out++->link = link;
  }
}

void ChunkLevel::place_blocks(const PlacedChunk& nodes, Bvh8& level) const {
  level.blocks.resize(blocks_.size());
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    const Block& from = blocks_[i];
    Bvh8::Block& block = level.blocks[i];
    for (std::uint32_t k = 0; k < block_width; ++k) {
      const std::uint32_t disc = from.disc[k];
      block.discs.x[k] = nodes.x[disc], block.discs.y[k] = nodes.y[disc];
      block.outer[k] = block.discs.radius[k] = nodes.radius[disc];
    }
    std::copy(from.child.begin(), from.child.end(), block.child);
    std::copy(from.node.begin(), from.node.end(), block.node);
  }
}

}  // namespace bch::detail
