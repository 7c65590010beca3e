// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "layout/shape_set/conservative_nodes.hpp"
#include "layout/shape_set/verify_parts.hpp"

namespace bch::detail::verification {
namespace {

/// The radius that a disc's centre needs to hold another.
double needed(const Disc& disc, const Disc& held) {
  return distance(disc, held) + static_cast<double>(held.radius);
}

/// The tree of one level that is more than a disc. Nodes are indices: of the inner ones, or leaf_bit + that of a cut disc.
class LevelTree {
 public:
  LevelTree(const Verifier& verifier, std::uint32_t level)
      : verifier_(verifier),
        level_(level),
        tree_(verifier.arrays().trees[verifier.root(level)]),
        cut_(verifier.cut(level)) {
    inner_.resize(cut_.count);
    std::memcpy(inner_.data(), nodes() + std::size_t{tree_.first_inner()} * inner_floats,
                inner_.size() * sizeof(InnerNode));
    for (InnerNode& node : inner_)  // links are within the level from here on
      node.link =
          (node.link & parent_of_cut_disc) | ((node.link - tree_.first_inner()) & ~parent_of_cut_disc);
    for (std::uint32_t i = 0; i < cut_.count; ++i)
      above_disc_.push_back(i - (inner_[i].link < parent_of_cut_disc));
  }

  void verify_parts() const {
    for (std::uint32_t i = 0; i < cut_.count; ++i) require_part(leaf_bit + i, above_disc_[i]);
    for (std::uint32_t i = 0; i + 1 < cut_.count; ++i) require_part(i, above(i));
  }

  void verify_conservative_nodes() const {
    if (tree_.conservative_nodes != 0 && !conservative_nodes(cut_, inner_, 0.999 * verifier_.max_extent))
      verifier_.report("trees", level_, "a node does not hold the discs below it, as the tree says");
  }

  void verify_blocks() {
    is_found_.assign(cut_.count, false);
    const Root& root = verifier_.arrays().roots[verifier_.root(level_)];
    std::vector<std::uint32_t> nodes_above;
    verify_outer({root.x, root.y, tree_.outer_radius}, visit(tree_.top, nodes_above));
    for (std::uint32_t i = 0; i < cut_.count; ++i)
      if (!is_found_[i])
        verifier_.report("nodes", level_,
                         "disc " + std::to_string(i) + " at " + text_of(disc(leaf_bit + i)) +
                             " is not below the nodes of the blocks above it");
  }

 private:
  /// Discs of the cut, from the first one that a node's leaf blocks show to the last: all of them, and those that are found
  /// below the node.
  struct Shown {
    std::uint32_t begin, end;
    std::vector<std::uint32_t> found;
  };

  const float* nodes() const { return verifier_.arrays().nodes.data(); }
  std::uint32_t above(std::uint32_t i) const { return inner_[i].link & ~parent_of_cut_disc; }
  Disc disc(std::uint32_t node) const {
    const std::uint32_t i = node & ~leaf_bit;
    if (node < leaf_bit) return {inner_[i].x, inner_[i].y, inner_[i].radius};
    return {cut_.x[i], cut_.y[i], cut_.radius[i]};
  }

  void require_part(std::uint32_t part, std::uint32_t whole) const {
    if (!may_be_part(disc(part), disc(whole), verifier_.tolerance()))
      verifier_.report("nodes", level_,
                       "a node's disc at " + text_of(disc(part)) + " sticks out of the one above, at " +
                           text_of(disc(whole)));
  }

  bool is_above(std::uint32_t node, std::uint32_t i) const {
    if (node >= leaf_bit) return node == leaf_bit + i;
    std::uint32_t at = above_disc_[i];
    while (at != node && at != above(at)) at = above(at);
    return at == node;
  }

  Shown visit(std::uint32_t name, std::vector<std::uint32_t>& nodes_above) {
    if (name >= leaf_bit) return visit_leaf_block((name & ~leaf_bit) - tree_.discs, nodes_above);
    Shown all{cut_.count, 0, {}};
    const float* const block = nodes() + name;
    for (std::uint32_t lane = 0; lane < block_width && block[lane] < infinity; ++lane) {
      const auto bits = [&](std::uint32_t field) {
        return std::bit_cast<std::uint32_t>(block[field + lane]);
      };
      const std::uint32_t node = bits(block_nodes);
      nodes_above.push_back(node < leaf_bit ? node - tree_.first_inner() : node - tree_.discs);
      const Shown shown = visit(bits(block_names), nodes_above);
      nodes_above.pop_back();
      verify_outer({block[lane], block[block_width + lane], block[block_outer + lane]}, shown);
      all.begin = std::min(all.begin, shown.begin), all.end = std::max(all.end, shown.end);
      all.found.insert(all.found.end(), shown.found.begin(), shown.found.end());
    }
    return all;
  }

  Shown visit_leaf_block(std::uint32_t begin, const std::vector<std::uint32_t>& nodes_above) {
    Shown shown{begin, std::min(begin + block_width, cut_.count), {}};
    for (std::uint32_t i = shown.begin; i < shown.end; ++i) {
      if (!std::all_of(nodes_above.begin(), nodes_above.end(),
                       [&](std::uint32_t node) { return is_above(node, i); }))
        continue;
      is_found_[i] = true;
      shown.found.push_back(i);
    }
    return shown;
  }

  void verify_outer(const Disc& outer, const Shown& shown) const {
    double least = 0, most = 0;
    for (const std::uint32_t i : shown.found) least = std::max(least, needed(outer, disc(leaf_bit + i)));
    for (std::uint32_t i = shown.begin; i < shown.end; ++i)
      most = std::max(most, needed(outer, disc(leaf_bit + i)));
    const double radius = outer.radius;
    if (radius < least || radius > most * (1 + 0x1p-18))
      verifier_.report("nodes", level_,
                       "an outer radius at " + text_of(outer) + " needs " + shortest(least) + " m");
  }

  const Verifier& verifier_;
  const std::uint32_t level_;
  const Tree tree_;
  const CutDiscs cut_;
  std::vector<InnerNode> inner_;
  std::vector<std::uint32_t> above_disc_;  ///< per cut disc, the node above it
  std::vector<bool> is_found_;             ///< per cut disc, by way of blocks
};

}  // namespace

double distance(const Disc& a, const Disc& b) {
  return std::hypot(static_cast<double>(a.x) - static_cast<double>(b.x),
                    static_cast<double>(a.y) - static_cast<double>(b.y));
}

/// The points that hold the smallest disc of a part in place do not fit into any half of it, so that one of them is
/// sqrt(d^2 + r^2) away from the centre of a disc that holds the whole.
bool may_be_part(const Disc& part, const Disc& whole, double tolerance) {
  const double d = distance(part, whole), r = part.radius,
               limit = static_cast<double>(whole.radius) + tolerance;
  return d * d + r * r <= limit * limit;
}

void verify_tree(const Verifier& verifier, std::uint32_t level) {
  if (verifier.arrays().roots[verifier.root(level)].row == single_disc) return;
  LevelTree tree(verifier, level);
  tree.verify_parts();
  tree.verify_conservative_nodes();
  tree.verify_blocks();
}

}  // namespace bch::detail::verification
