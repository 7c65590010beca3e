// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/wide_tree.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "layout/cut_lanes.hpp"
#include "layout/rounding.hpp"

namespace bch {
namespace {

using Lanes = CutLanes<xsimd::sse2>;

/// Discs that may be read beyond a run's.
constexpr std::size_t padding = 16;

constexpr WideTree::Block empty_block = [] {
  WideTree::Block block{};
  for (float& x : block.discs.x) x = std::numeric_limits<float>::infinity();
  return block;
}();

}  // namespace

void Flattener::begin(const Hierarchy& hierarchy) {
  hierarchy_ = &hierarchy;
  const std::size_t count = hierarchy.nodes.size();
  position_.resize(count);
  for (auto* array : {&x_, &y_, &radius_}) array->resize(std::max(array->size(), count + padding));
}

void Flattener::cut(std::uint32_t depth) {
  // In local variables, because a member's last store would have to be waited for at every node.
  const HierarchyNode* const nodes = hierarchy_->nodes.data();
  std::uint32_t* const position = position_.data();
  float *const x = x_.data(), *const y = y_.data(), *const radius = radius_.data();
  std::uint32_t count = 0;
  const auto visit = [&](std::uint32_t node, bool is_cut) {
    const Disc disc = nodes[node].disc;
    position[node] = count;
    x[count] = disc.x, y[count] = disc.y, radius[count] = disc.radius;
    count += is_cut;
  };
  if (depth == all_depths) {
    const auto all = static_cast<std::uint32_t>(hierarchy_->nodes.size());
    for (std::uint32_t i = 0; i < all; ++i) visit(i, nodes[i].is_leaf());
    count_ = count;
    return;
  }
  open_.assign(1, {0, depth});
  while (!open_.empty()) {
    auto [node, left] = open_.back();
    open_.pop_back();
    for (; left > 0 && !nodes[node].is_leaf(); ++node) {
      position[node] = count;
      open_.push_back({nodes[node].second_child, --left});
    }
    visit(node, true);
  }
  count_ = count;
}

void Flattener::flatten(std::uint32_t depth, WideTree& tree) {
  cut(depth);
  tree.is_single = count_ == 1;
  const std::uint32_t padded = std::max(count_, block_width);
  std::fill(x_.begin() + count_, x_.begin() + padded, std::numeric_limits<float>::infinity());
  std::fill(y_.begin() + count_, y_.begin() + padded, 0.0f);
  std::fill(radius_.begin() + count_, radius_.begin() + padded, 0.0f);
  tree.x.assign(x_.begin(), x_.begin() + padded);
  tree.y.assign(y_.begin(), y_.begin() + padded);
  tree.radius.assign(radius_.begin(), radius_.begin() + padded);
  if (!grow(&Flattener::subtrees, tree)) grow(&Flattener::even_runs, tree);
}

/// Breadth first. False where the tree would be too deep.
bool Flattener::grow(Split split, WideTree& tree) {
  const Group all{0, count_, 0};
  tree.root = tree.is_single ? Disc{x_[0], y_[0], radius_[0]} : enclosing(all);
  tree.top = is_window(all) ? window(all) : 0;
  tree.blocks.clear();
  level_.clear();
  if (!is_window(all)) level_.push_back(all);
  for (std::uint32_t depth = 1; !level_.empty(); ++depth) {
    if (depth == most_wide_levels) return false;
    next_.clear();
    const auto next_block = static_cast<std::uint32_t>(tree.blocks.size() + level_.size());
    for (const Group& group : level_) {
      const Parts parts = (this->*split)(group);
      WideTree::Block& block = tree.blocks.emplace_back(empty_block);
      for (std::uint32_t i = 0; i < parts.count; ++i) {
        const Disc around = enclosing(parts.group[i]);
        block.discs.x[i] = around.x, block.discs.y[i] = around.y, block.discs.radius[i] = around.radius;
        block.child[i] = is_window(parts.group[i]) ? window(parts.group[i])
                                                   : next_block + static_cast<std::uint32_t>(next_.size());
        if (!is_window(parts.group[i])) next_.push_back(parts.group[i]);
      }
    }
    std::swap(level_, next_);
  }
  return true;
}

std::uint32_t Flattener::window(const Group& group) const {
  return leaf_window + std::min(group.begin, count_ < block_width ? 0 : count_ - block_width);
}

/// Of expanding a group.
double Flattener::worth(const Group& group) const {
  if (group.size() == 1) return 0;
  return static_cast<double>(hierarchy_->nodes[group.node].disc.radius) * group.size();
}

Flattener::Parts Flattener::subtrees(const Group& group) const {
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
void Flattener::expand(Parts& parts, std::uint32_t index) const {
  for (std::uint32_t i = parts.count++; i > index + 1; --i)
    parts.group[i] = parts.group[i - 1], parts.worth[i] = parts.worth[i - 1];
  Group &first = parts.group[index], &other = parts.group[index + 1];
  const std::uint32_t second = hierarchy_->nodes[first.node].second_child;
  other = {position_[second], first.end, second};
  first = {first.begin, position_[second], first.node + 1};
  parts.worth[index] = worth(first), parts.worth[index + 1] = worth(other);
}

Flattener::Parts Flattener::even_runs(const Group& group) const {
  Parts parts;
  parts.count = std::min(group.size(), block_width);
  const auto at = [&](std::uint64_t k) {
    return static_cast<std::uint32_t>(group.begin + k * group.size() / parts.count);
  };
  for (std::uint32_t i = 0; i < parts.count; ++i) parts.group[i] = {at(i), at(i + 1), 0};
  return parts;
}

/// A disc about the middle of the centres' extent, or about the binary node's centre, whichever is smaller.
Disc Flattener::enclosing(const Group& group) const {
  const DiscRun run{x_.data() + group.begin, y_.data() + group.begin, radius_.data() + group.begin,
                    group.size()};
  const Disc& node = hierarchy_->nodes[group.node].disc;
  const auto [low, high] = Lanes::extent(run);
  const Vec2 centre[2] = {{node.x, node.y}, {0.5f * (low.x + high.x), 0.5f * (low.y + high.y)}};
  float radius[2];
  Lanes::radii(run, centre, radius);
  const int smaller = radius[0] <= radius[1] ? 0 : 1;
  return {centre[smaller].x, centre[smaller].y,
          rounding::round_up(static_cast<double>(radius[smaller]) * (1 + 0x1p-21) +
                             rounding::nesting_margin * hierarchy_->reach)};
}

Supports Flattener::supports() const {
  return bch::supports(x_.data(), y_.data(), radius_.data(), count_, hierarchy_->reach);
}

Outer Flattener::outer(const Profile& profile) const {
  return bch::outer(profile, x_.data(), y_.data(), radius_.data(), count_, hierarchy_->reach);
}

WideTree wide_tree(const Hierarchy& hierarchy, std::uint32_t depth) {
  WideTree tree;
  Flattener flattener;
  flattener.begin(hierarchy);
  flattener.flatten(depth, tree);
  return tree;
}

}  // namespace bch
