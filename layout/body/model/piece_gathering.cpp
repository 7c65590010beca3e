// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/body/model/piece_gathering.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace bch::detail {
namespace {

constexpr int passes = 3;  ///< the first of which only do what is cheap

class Gatherer {
 public:
  Gatherer(const SkinPieces& skin, SphereFit& fit, const GatheringCosts& costs)
      : skin_(skin),
        fit_(fit),
        costs_(costs),
        owner_(skin.nodes.size(), none),
        parent_(skin.nodes.size(), none),
        at_(fit.point_count()) {
    for (std::uint32_t n = 0; n < skin.nodes.size(); ++n)
      if (!is_piece(n))
        for (const std::uint32_t child : skin.nodes[n].children) parent_[child] = n;
    // Children follow their parents.
    for (std::uint32_t n = static_cast<std::uint32_t>(skin.nodes.size()); n-- > 0;) find_owner(n);
    for (const std::uint32_t root : skin.roots) list(root, 1);
  }

  void pass(float worth) {
    for (std::uint32_t n = 0; n < owner_.size(); ++n)
      if (parent_[n] == none || owner_[parent_[n]] == none) improve(n, worth);
    for (SphereFit::Ball& ball : fit_.balls) fit_.refit(ball);
  }

 private:
  /// Counts the cells of a sphere that have a point as corner.
  struct Listing {
    std::uint32_t sphere;
    int cells;
  };

  bool is_piece(std::uint32_t node) const { return skin_.nodes[node].piece != SkinPieces::no_child; }

  void find_owner(std::uint32_t node) {
    const auto& [first, second] = skin_.nodes[node].children;
    if (is_piece(node))
      owner_[node] = fit_.owner[skin_.nodes[node].piece];
    else
      owner_[node] = owner_[first] == owner_[second] ? owner_[first] : none;
  }

  /// Lists the corners of all cells of a node once more, or once less: the largest nodes of which all is one sphere's.
  void list(std::uint32_t node, int change) {
    if (owner_[node] == none) {
      for (const std::uint32_t child : skin_.nodes[node].children) list(child, change);
      return;
    }
    for (const std::uint32_t corner : skin_.nodes[node].corners) {
      std::vector<Listing>& of = at_[corner];
      auto found =
          std::find_if(of.begin(), of.end(), [&](const Listing& l) { return l.sphere == owner_[node]; });
      const std::size_t before = of.size();
      if (found == of.end()) found = of.insert(of.end(), {owner_[node], 0});
      found->cells += change;
      if (found->cells == 0) of.erase(found);
      cost_ += static_cast<int>(of.size()) - static_cast<int>(before);
      // The points of cuts have to be placed as well.
      if (fit_.is_cut(corner)) cost_ += (of.empty() ? 0 : 1) - (before == 0 ? 0 : 1);
    }
  }

  void give(std::uint32_t node, std::uint32_t to) {
    owner_[node] = to;
    if (!is_piece(node))
      for (const std::uint32_t child : skin_.nodes[node].children) give(child, to);
  }

  void hand_over(std::uint32_t node, std::uint32_t to) {
    if (!is_piece(node)) {
      for (const std::uint32_t child : skin_.nodes[node].children) hand_over(child, to);
    } else if (fit_.owner[skin_.nodes[node].piece] != to) {
      fit_.hand_over(skin_.nodes[node].piece, to);
    }
  }

  std::uint32_t count(std::uint32_t node, std::uint32_t sphere) const {
    if (is_piece(node)) return owner_[node] == sphere ? 1 : 0;
    const auto& [first, second] = skin_.nodes[node].children;
    return count(first, sphere) + count(second, sphere);
  }

  /// Says whether some sphere has no pieces but those of `all`; `node` is `all` or below it.
  bool is_last_of_some(std::uint32_t node, std::uint32_t all) const {
    if (const std::uint32_t of = owner_[node]; of != none)
      return fit_.balls[of].pieces.size() == count(all, of);
    const auto& children = skin_.nodes[node].children;
    return std::any_of(children.begin(), children.end(),
                       [&](std::uint32_t child) { return is_last_of_some(child, all); });
  }

  /// Returns the highest node of which all is one sphere's when that of `node` is.
  std::uint32_t top(std::uint32_t node, std::uint32_t to) const {
    for (std::uint32_t above; (above = parent_[node]) != none; node = above)
      for (const std::uint32_t child : skin_.nodes[above].children)
        if (child != node && owner_[child] != to) return node;
    return node;
  }

  void improve(std::uint32_t node, float worth) {
    if (is_last_of_some(node, node)) return;
    std::vector<std::uint32_t> receivers;
    for (const std::uint32_t corner : skin_.nodes[node].corners)
      for (const Listing& listing : at_[corner])
        if (listing.sphere != owner_[node] &&
            std::find(receivers.begin(), receivers.end(), listing.sphere) == receivers.end())
          receivers.push_back(listing.sphere);
    std::uint32_t best = none;
    float best_gain = 0;
    for (const std::uint32_t to : receivers) {
      const float cost = costs_.price(to, skin_.nodes[node].corners);
      if (cost > 20 * worth) continue;  // no node has more corners to lose
      const float gain = worth * static_cast<float>(saved(node, to)) - cost;
      if (gain > best_gain) best_gain = gain, best = to;
    }
    if (best == none) return;
    take(top(node, best), node, best);
    costs_.grow(best, skin_.nodes[node].corners);
    hand_over(node, best);
  }

  /// Makes a node another sphere's, `above` being what then becomes one cell.
  void take(std::uint32_t above, std::uint32_t node, std::uint32_t to) {
    list(above, -1);
    give(node, to);
    give(above, to);
    list(above, 1);
  }

  /// Returns how many corners and cuts go when a node becomes another sphere's.
  int saved(std::uint32_t node, std::uint32_t to) {
    const std::uint32_t above = top(node, to);
    const int before = cost_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> owners;
    remember(above, owners);
    take(above, node, to);
    const int after = cost_;
    list(above, -1);
    for (const auto& [of, owner] : owners) owner_[of] = owner;
    list(above, 1);
    return before - after;
  }

  void remember(std::uint32_t node, std::vector<std::pair<std::uint32_t, std::uint32_t>>& owners) const {
    owners.emplace_back(node, owner_[node]);
    if (!is_piece(node))
      for (const std::uint32_t child : skin_.nodes[node].children) remember(child, owners);
  }

  static constexpr std::uint32_t none = 0xffffffff;

  const SkinPieces& skin_;
  SphereFit& fit_;
  const GatheringCosts& costs_;
  std::vector<std::uint32_t> owner_;  ///< of nodes, none where pieces have several
  std::vector<std::uint32_t> parent_;
  std::vector<std::vector<Listing>> at_;  ///< by point
  int cost_ = 0;
};

}  // namespace

void gather_pieces(const SkinPieces& skin, SphereFit& fit, const GatheringCosts& costs) {
  Gatherer gatherer(skin, fit, costs);
  for (int i = passes; i-- > 0;) gatherer.pass(costs.worth_of_corner / static_cast<float>(1 << (2 * i)));
}

}  // namespace bch::detail
