// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/shape_set/animated_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "layout/base/rounding.hpp"
#include "layout/hierarchy/disc_box.hpp"

namespace bch::detail {
namespace {

double distance(const Disc& a, const Disc& b) noexcept {
  return length(double{a.x} - double{b.x}, double{a.y} - double{b.y});
}

/// Where a range of discs falls into two, and what that costs: the sizes of both parts, times their discs.
struct Split {
  std::vector<std::uint32_t> order;
  std::size_t first = 0;
  double cost = HUGE_VAL;
};

class Builder {
 public:
  explicit Builder(const AnimatedChunk& chunk) : chunk_(chunk) {
    tree_.times = chunk.times;
    tree_.ring_ends = chunk.ring_ends;
    tree_.leaf_of_disc.resize(chunk.disc_count);
    const std::size_t keys = chunk.times.size(), looked_at = std::min<std::size_t>(keys, most_keys);
    for (std::size_t i = 0; i < looked_at; ++i) sampled_keys_.push_back(i * (keys - 1) / (looked_at - 1));
  }

  AnimatedTreeChunk build() {
    std::vector<std::uint32_t> all(chunk_.disc_count);
    std::iota(all.begin(), all.end(), 0u);
    tree_.first_child.push_back(0);
    std::vector<Open> open = {{0, std::move(all)}};
    while (!open.empty()) open = divide(open);
    place_discs();
    for (unsigned level = 0; level < window_levels; ++level) find_windows(level);
    return std::move(tree_);
  }

 private:
  static constexpr std::size_t most_keys = 8;  ///< that a split looks at

  const Disc& disc(std::size_t key, std::uint32_t i) const {
    return chunk_.keys[key * chunk_.disc_count + i];
  }

  /// A node, and the discs that it holds.
  struct Open {
    std::uint32_t node;
    std::vector<std::uint32_t> discs;
  };

  /// Keeps what the nodes of a level hold, and returns those of the next one.
  std::vector<Open> divide(std::vector<Open>& level) {
    std::vector<Open> below;
    for (Open& open : level) {
      if (open.discs.size() == 1) {
        tree_.leaf_of_disc[open.discs[0]] = open.node;
      } else {
        const Split split = best_split(open.discs);
        const auto middle = split.order.begin() + static_cast<std::ptrdiff_t>(split.first);
        const auto child = static_cast<std::uint32_t>(tree_.first_child.size());
        tree_.first_child[open.node] = child;
        tree_.first_child.resize(child + 2, 0);
        below.push_back({child, {split.order.begin(), middle}});
        below.push_back({child + 1, {middle, split.order.end()}});
      }
      held_.push_back(std::move(open.discs));
    }
    return below;
  }

  /// Returns a small disc that holds discs: its centre goes from the middle of their box towards the farthest one, by less and less
  /// (Badoiu, Clarkson 2003).
  Disc disc_about(std::size_t key, std::span<const std::uint32_t> discs) const {
    if (discs.size() == 1) return disc(key, discs[0]);
    DiscBox box;
    for (const std::uint32_t i : discs) box.add(disc(key, i));
    double x = (box.low_x + box.high_x) / 2, y = (box.low_y + box.high_y) / 2, least = HUGE_VAL;
    Disc best;
    for (int step = 4; step < 16; ++step) {
      const Disc centre{static_cast<float>(x), static_cast<float>(y), 0};
      double radius = 0, away = 0;
      const Disc* farthest = nullptr;
      for (const std::uint32_t i : discs) {
        const Disc& each = disc(key, i);
        const double to_centre = distance(each, centre), to_edge = to_centre + double{each.radius};
        if (to_edge <= radius && farthest != nullptr) continue;
        radius = to_edge, away = to_centre, farthest = &each;
      }
      if (radius < least) least = radius, best = centre;
      if (away == 0) break;
      // As far as the farthest point of that disc draws it, towards which its centre lies.
      const double share = radius / away / step;
      x += (double{farthest->x} - x) * share, y += (double{farthest->y} - y) * share;
    }
    best.radius = rounding::round_up(least * (1 + 0x1p-48));
    return best;
  }

  /// Discs without rings stay in their order, by which queries number them. Others may be sorted along an axis.
  Split best_split(std::span<const std::uint32_t> discs) const {
    Split best;
    try_order({discs.begin(), discs.end()}, best);
    if (chunk_.ring_ends.empty()) return best;
    for (float Disc::*const axis : {&Disc::x, &Disc::y}) {
      std::vector<std::uint32_t> order(discs.begin(), discs.end());
      std::vector<double> along(chunk_.disc_count, 0.0);
      for (const std::uint32_t i : discs)
        for (const std::size_t key : sampled_keys_) along[i] += double{disc(key, i).*axis};
      std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return along[a] != along[b] ? along[a] < along[b] : a < b;
      });
      try_order(std::move(order), best);
    }
    return best;
  }

  void try_order(std::vector<std::uint32_t> order, Split& best) const {
    const std::size_t count = order.size();
    std::vector<double> cost(count, 0.0);  // of a split before each
    for (const std::size_t key : sampled_keys_) {
      DiscBox first, rest;
      for (std::size_t i = 1; i < count; ++i) {
        first.add(disc(key, order[i - 1])), rest.add(disc(key, order[count - i]));
        cost[i] += first.size() * static_cast<double>(i);
        cost[count - i] += rest.size() * static_cast<double>(i);
      }
    }
    const auto least = std::min_element(cost.begin() + 1, cost.end());
    if (*least < best.cost) best = {std::move(order), static_cast<std::size_t>(least - cost.begin()), *least};
  }

  void place_discs() {
    tree_.keys.reserve(held_.size() * chunk_.times.size());
    for (std::size_t key = 0; key < chunk_.times.size(); ++key)
      for (const std::vector<std::uint32_t>& discs : held_) tree_.keys.push_back(disc_about(key, discs));
  }

  void find_windows(unsigned level) {
    KeyWindows& windows = tree_.windows[level];
    for (std::size_t key = 0; key + 1 < chunk_.times.size(); key += window_length(level)) {
      const std::size_t end = tree_.window_end(key, level);
      const Disc *const from = tree_.key(key), *const to = tree_.key(end);
      double step = 0;
      for (std::size_t i = 0; i < tree_.nodes(); ++i) {
        step = std::max(step, distance(from[i], to[i]));
        if (level > 0) windows.spares.push_back(spare(i, key, end));
      }
      windows.steps.push_back(rounding::round_up(step * (1 + 0x1p-48)));
    }
  }

  /// Returns by how much a node is outside of the disc that goes straight on from one key to another, at the keys between. That is convex
  /// from key to key, and so no more there.
  float spare(std::size_t node, std::size_t key, std::size_t end) const {
    const Disc &from = tree_.key(key)[node], &to = tree_.key(end)[node];
    double spare = 0;
    for (std::size_t k = key + 1; k < end; ++k) {
      const double share = (tree_.times[k] - tree_.times[key]) / (tree_.times[end] - tree_.times[key]);
      const auto blend = [=](float a, float b) { return double{a} + (double{b} - double{a}) * share; };
      const Disc& disc = tree_.key(k)[node];
      const double away = length(double{disc.x} - blend(from.x, to.x), double{disc.y} - blend(from.y, to.y));
      spare = std::max(spare, away + double{disc.radius} - blend(from.radius, to.radius));
    }
    return rounding::round_up(spare * (1 + 0x1p-40));
  }

  const AnimatedChunk& chunk_;
  AnimatedTreeChunk tree_;
  std::vector<std::size_t> sampled_keys_;
  std::vector<std::vector<std::uint32_t>> held_;  ///< per node: its discs
};

}  // namespace

AnimatedTreeChunk animated_tree_chunk(const AnimatedChunk& chunk) {
  return Builder(chunk).build();
}

KeyPlace key_place(const AnimatedTree& tree, double seconds) noexcept {
  const auto& chunks = tree.chunks;
  std::size_t chunk = chunks.size() - 1;
  while (chunk > 0 && seconds < chunks[chunk].times.front()) --chunk;
  const std::vector<double>& times = chunks[chunk].times;
  const auto after = std::upper_bound(times.begin() + 1, times.end() - 1, seconds);
  const double from = after[-1], to = *after;
  return {chunk, static_cast<std::size_t>(after - times.begin() - 1),
          std::clamp((seconds - from) / (to - from), 0.0, 1.0)};
}

double time_in_clip(const AnimatedTree& tree, double seconds) noexcept {
  const double begin = tree.begin(), length = tree.end() - begin;
  if (!tree.loops) return seconds;
  return seconds - std::floor((seconds - begin) / length) * length;
}

}  // namespace bch::detail
