// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/shape_set/bvh8.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "layout/base/rounding.hpp"
#include "layout/culling/cut_lanes.hpp"
#include "layout/shape_set/conservative_nodes.hpp"

namespace bch::detail {
namespace {

/// Discs that may be read beyond a run's.
constexpr std::size_t spare_lanes = 16;

constexpr Bvh8::Block empty_block = [] {
  Bvh8::Block block{};
  for (float& x : block.discs.x) x = std::numeric_limits<float>::infinity();
  return block;
}();

}  // namespace

void Bvh8Builder::begin(const Hierarchy& hierarchy) {
  hierarchy_ = &hierarchy;
  const std::size_t count = hierarchy.nodes.size();
  for (auto* array : {&position_, &parent_}) array->resize(count);
  for (auto* array : {&x_, &y_, &radius_}) array->resize(std::max(array->size(), count + spare_lanes));
}

void Bvh8Builder::cut(std::uint32_t depth) {
  // Local variables, because a member's last store would have to be waited for at every node.
  const Hierarchy::Node* const nodes = hierarchy_->nodes.data();
  std::uint32_t *const position = position_.data(), *const parent = parent_.data();
  float *const x = x_.data(), *const y = y_.data(), *const radius = radius_.data();
  std::uint32_t count = 0;
  inner_.clear();
  const auto visit_inner = [&](std::uint32_t node) {
    position[node] = count;
    parent[node + 1] = parent[nodes[node].second_child] = node;
    inner_.push_back(node);
  };
  const auto visit_cut = [&](std::uint32_t node) {
    const Disc disc = nodes[node].disc;
    position[node] = count;
    x[count] = disc.x, y[count] = disc.y, radius[count] = disc.radius;
    ++count;
  };
  parent[0] = 0;
  pending_.assign(1, {0, depth});
  while (!pending_.empty()) {
    auto [node, levels_left] = pending_.back();
    pending_.pop_back();
    for (; levels_left > 0 && !nodes[node].is_leaf(); ++node) {
      visit_inner(node);
      pending_.push_back({nodes[node].second_child, --levels_left});
    }
    visit_cut(node);
  }
  count_ = count;
}

void Bvh8Builder::flatten(std::uint32_t depth, Bvh8& tree) {
  cut(depth);
  tree.count = count_;
  const std::uint32_t padded = std::max(count_, block_width);
  std::fill(x_.begin() + count_, x_.begin() + padded, std::numeric_limits<float>::infinity());
  std::fill(y_.begin() + count_, y_.begin() + padded, 0.0f);
  std::fill(radius_.begin() + count_, radius_.begin() + padded, 0.0f);
  tree.x.assign(x_.begin(), x_.begin() + padded);
  tree.y.assign(y_.begin(), y_.begin() + padded);
  tree.radius.assign(radius_.begin(), radius_.begin() + padded);
  take_inner(tree);
  tree.conservative_nodes = conservative_nodes({x_.data(), y_.data(), radius_.data(), count_},
                                               tree.inner_nodes, hierarchy_->max_extent);
  if (!grow(&Bvh8Builder::subtrees, tree)) grow(&Bvh8Builder::even_runs, tree);
}

/// Returns the place of a node above the cut in the in-order sequence of these nodes.
std::uint32_t Bvh8Builder::place(std::uint32_t node) const {
  return position_[hierarchy_->nodes[node].second_child] - 1;
}

void Bvh8Builder::take_inner(Bvh8& tree) const {
  const Hierarchy::Node* const nodes = hierarchy_->nodes.data();
  tree.inner_nodes.resize(count_);
  const Disc& root = nodes[0].disc;
  tree.inner_nodes.back() =
      tree.is_single() ? InnerNode{root.x, root.y, root.radius, parent_of_cut_disc} : InnerNode{};
  for (const std::uint32_t node : inner_) {
    const Disc& disc = nodes[node].disc;
    const std::uint32_t is_above_cut = place(node) == position_[node] ? parent_of_cut_disc : 0;
    tree.inner_nodes[place(node)] = {disc.x, disc.y, disc.radius, place(parent_[node]) | is_above_cut};
  }
}

/// Grows the tree breadth first. Returns false where the tree would be too deep.
bool Bvh8Builder::grow(Split split, Bvh8& tree) {
  const Group all{0, count_, 0, count_};
  tree.root = hierarchy_->nodes[0].disc;
  tree.outer_radius = outer_radius(all);
  tree.top = is_leaf_block(all) ? leaf_block(all) : 0;
  tree.blocks.clear();
  level_.clear();
  if (!is_leaf_block(all)) level_.push_back(all);
  for (std::uint32_t depth = 1; !level_.empty(); ++depth) {
    if (depth == max_wide_levels) return false;
    next_.clear();
    const auto next_block = static_cast<std::uint32_t>(tree.blocks.size() + level_.size());
    for (const Group& group : level_) {
      const Parts parts = (this->*split)(group);
      Bvh8::Block& block = tree.blocks.emplace_back(empty_block);
      for (std::uint32_t i = 0; i < parts.count; ++i) {
        const Group& part = parts.group[i];
        const Disc& disc = hierarchy_->nodes[part.node].disc;
        block.discs.x[i] = disc.x, block.discs.y[i] = disc.y, block.discs.radius[i] = disc.radius;
        block.outer_radius[i] = outer_radius(part);
        block.node[i] = part.node_end - position_[part.node] == 1 ? leaf_bit + part.begin : place(part.node);
        block.child[i] =
            is_leaf_block(part) ? leaf_block(part) : next_block + static_cast<std::uint32_t>(next_.size());
        if (!is_leaf_block(part)) next_.push_back(part);
      }
    }
    std::swap(level_, next_);
  }
  return true;
}

std::uint32_t Bvh8Builder::leaf_block(const Group& group) const {
  return leaf_bit + std::min(group.begin, count_ < block_width ? 0 : count_ - block_width);
}

/// Returns the worth of expanding a group.
double Bvh8Builder::worth(const Group& group) const {
  if (group.size() == 1) return 0;
  return static_cast<double>(hierarchy_->nodes[group.node].disc.radius) * group.size();
}

Bvh8Builder::Parts Bvh8Builder::subtrees(const Group& group) const {
  Parts parts;
  parts.group[0] = group, parts.worth[0] = worth(group);
  parts.count = 1;
  while (parts.count < block_width) {
    std::uint32_t best = 0;
    for (std::uint32_t i = 1; i < parts.count; ++i) best = parts.worth[i] > parts.worth[best] ? i : best;
    if (parts.group[best].size() == 1) break;
    expand(parts, best);
  }
  return parts;
}

/// Replaces a group by those of its node's children.
void Bvh8Builder::expand(Parts& parts, std::uint32_t index) const {
  for (std::uint32_t i = parts.count++; i > index + 1; --i)
    parts.group[i] = parts.group[i - 1], parts.worth[i] = parts.worth[i - 1];
  Group &first = parts.group[index], &other = parts.group[index + 1];
  const std::uint32_t second = hierarchy_->nodes[first.node].second_child;
  other = {position_[second], first.end, second, first.end};
  first = {first.begin, position_[second], first.node + 1, position_[second]};
  parts.worth[index] = worth(first), parts.worth[index + 1] = worth(other);
}

Bvh8Builder::Parts Bvh8Builder::even_runs(const Group& group) const {
  Parts parts;
  parts.count = std::min(group.size(), block_width);
  const auto at = [&](std::uint64_t k) {
    return static_cast<std::uint32_t>(group.begin + k * group.size() / parts.count);
  };
  for (std::uint32_t i = 0; i < parts.count; ++i) {
    parts.group[i] = {at(i), at(i + 1), group.node, group.node_end};
    find_lowest_node(parts.group[i]);
  }
  return parts;
}

/// Goes down from the node that a group has, as long as one child is above all of the group.
void Bvh8Builder::find_lowest_node(Group& group) const {
  while (group.node_end - position_[group.node] > 1) {
    const std::uint32_t second = hierarchy_->nodes[group.node].second_child, middle = position_[second];
    if (group.begin < middle && group.end > middle) break;
    if (group.begin >= middle)
      group.node = second;
    else
      group.node = group.node + 1, group.node_end = middle;
  }
}

/// The radius about the centre of a group's node that holds its discs.
float Bvh8Builder::outer_radius(const Group& group) const {
  const DiscRun run{x_.data() + group.begin, y_.data() + group.begin, radius_.data() + group.begin,
                    group.size()};
  const Disc& node = hierarchy_->nodes[group.node].disc;
  return rounding::round_up(static_cast<double>(CutLanes<BaseLanes>::radius(run, {node.x, node.y})) *
                            (1 + 0x1p-21));
}

Supports Bvh8Builder::supports() const {
  return detail::supports(x_.data(), y_.data(), radius_.data(), count_, hierarchy_->max_extent);
}

Outer Bvh8Builder::outer(const Profile& profile) const {
  return detail::outer(profile, x_.data(), y_.data(), radius_.data(), count_, hierarchy_->max_extent);
}

Bvh8 bvh8(const Hierarchy& hierarchy, std::uint32_t depth) {
  Bvh8 tree;
  Bvh8Builder builder;
  builder.begin(hierarchy);
  builder.flatten(depth, tree);
  return tree;
}

}  // namespace bch::detail
