// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/wide_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "layout/rounding.hpp"

namespace bch {
namespace {

/// A run of the cut's discs, and where it is a subtree of the binary tree, that subtree's root.
struct Group {
  std::uint32_t begin, end;  ///< in the list of cut discs
  std::uint32_t node;        ///< of the hierarchy; used by subtree grouping only

  std::uint32_t size() const { return end - begin; }
};

class Flattener {
 public:
  Flattener(const Hierarchy& hierarchy, std::uint32_t depth)
      : hierarchy_(hierarchy), cut_(cut(hierarchy, depth)) {}

  WideTree flatten() {
    if (auto tree = grow(&Flattener::subtrees)) return std::move(*tree);
    return std::move(*grow(&Flattener::even_runs));
  }

 private:
  using Groups = std::vector<Group>;

  /// Breadth first. Empty where the tree would be too deep.
  std::optional<WideTree> grow(Groups (Flattener::*split)(const Group&) const) {
    WideTree tree;
    for (std::uint32_t i = 0; i < cut_.size(); ++i) tree.discs.push_back(disc(i));
    tree.discs.resize(std::max<std::size_t>(cut_.size(), block_width), padding);
    tree.is_single = cut_.size() == 1;
    const Group all{0, static_cast<std::uint32_t>(cut_.size()), 0};
    tree.root = tree.is_single ? disc(0) : enclosing(all);
    tree.top = is_window(all) ? window(all) : 0;

    std::vector<Group> level;
    if (!is_window(all)) level.push_back(all);
    for (std::uint32_t depth = 1; !level.empty(); ++depth) {
      if (depth == most_wide_levels) return std::nullopt;
      std::vector<Group> next;
      const auto next_block = static_cast<std::uint32_t>(tree.blocks.size() + level.size());
      for (const Group& group : level) {
        const Groups parts = (this->*split)(group);
        WideTree::Block& block = tree.blocks.emplace_back();
        for (std::uint32_t lane = 0; lane < block_width; ++lane) {
          const Disc around = lane < parts.size() ? enclosing(parts[lane]) : padding;
          block.discs.x[lane] = around.x, block.discs.y[lane] = around.y,
          block.discs.radius[lane] = around.radius;
          if (lane >= parts.size()) continue;
          if (is_window(parts[lane])) {
            block.child[lane] = window(parts[lane]);
          } else {
            block.child[lane] = next_block + static_cast<std::uint32_t>(next.size());
            next.push_back(parts[lane]);
          }
        }
      }
      level = std::move(next);
    }
    return tree;
  }

  static constexpr Disc padding{std::numeric_limits<float>::infinity(), 0, 0};

  static bool is_window(const Group& group) { return group.size() <= block_width; }

  std::uint32_t window(const Group& group) const {
    const auto count = static_cast<std::uint32_t>(cut_.size());
    return leaf_window + std::min(group.begin, count < block_width ? 0 : count - block_width);
  }

  /// The binary node's descendants, the one with most of the cut's discs expanded first. What fits into one window stays whole.
  Groups subtrees(const Group& group) const {
    Groups parts = children(group);
    while (parts.size() < block_width) {
      const auto worth = [&](const Group& g) {
        if (g.size() == 1) return 0.0;
        return static_cast<double>(enclosing(g).radius) * g.size();
      };
      const auto largest = std::max_element(
          parts.begin(), parts.end(), [&](const Group& a, const Group& b) { return worth(a) < worth(b); });
      if (worth(*largest) == 0) break;
      const Groups expanded = children(*largest);
      *largest = expanded[0];
      parts.insert(largest + 1, expanded[1]);
    }
    return parts;
  }

  Groups children(const Group& group) const {
    const std::uint32_t second = hierarchy_.nodes[group.node].second_child;
    const auto middle = std::lower_bound(cut_.begin() + group.begin, cut_.begin() + group.end, second);
    const auto split = static_cast<std::uint32_t>(middle - cut_.begin());
    return {{group.begin, split, group.node + 1}, {split, group.end, second}};
  }

  Groups even_runs(const Group& group) const {
    Groups parts;
    const std::uint32_t count = std::min(group.size(), block_width);
    for (std::uint32_t i = 0; i < count; ++i) {
      const auto at = [&](std::uint64_t k) {
        return static_cast<std::uint32_t>(group.begin + k * group.size() / count);
      };
      parts.push_back({at(i), at(i + 1), 0});
    }
    return parts;
  }

  const Disc& disc(std::uint32_t i) const { return hierarchy_.nodes[cut_[i]].disc; }

  /// A disc about the middle of the centres' extent, or about the binary node's centre, whichever is smaller.
  Disc enclosing(const Group& group) const {
    const Disc& node = hierarchy_.nodes[group.node].disc;
    float low_x = HUGE_VALF, low_y = HUGE_VALF, high_x = -HUGE_VALF, high_y = -HUGE_VALF;
    for (std::uint32_t i = group.begin; i < group.end; ++i) {
      low_x = std::min(low_x, disc(i).x), high_x = std::max(high_x, disc(i).x);
      low_y = std::min(low_y, disc(i).y), high_y = std::max(high_y, disc(i).y);
    }
    const Disc about_node = enclosing(group, {node.x, node.y});
    const Disc about_middle = enclosing(group, {0.5f * (low_x + high_x), 0.5f * (low_y + high_y)});
    return about_node.radius <= about_middle.radius ? about_node : about_middle;
  }

  Disc enclosing(const Group& group, Vec2 centre) const {
    double radius = 0;
    for (std::uint32_t i = group.begin; i < group.end; ++i) {
      const double x = static_cast<double>(disc(i).x) - static_cast<double>(centre.x);
      const double y = static_cast<double>(disc(i).y) - static_cast<double>(centre.y);
      radius = std::max(radius, std::sqrt(x * x + y * y) + static_cast<double>(disc(i).radius));
    }
    return {centre.x, centre.y,
            rounding::round_up(radius * (1 + 0x1p-50) + rounding::nesting_margin * hierarchy_.reach)};
  }

  const Hierarchy& hierarchy_;
  std::vector<std::uint32_t> cut_;
};

}  // namespace

WideTree wide_tree(const Hierarchy& hierarchy, std::uint32_t depth) {
  return Flattener(hierarchy, depth).flatten();
}

}  // namespace bch
