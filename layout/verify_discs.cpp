// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "layout/profile.hpp"
#include "layout/rounding.hpp"
#include "layout/supports.hpp"
#include "layout/verify_parts.hpp"

// What follows from a shape's discs alone.

namespace bch::verification {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

Disc disc_at(const float* x, std::size_t stride, std::uint32_t i) {
  return {x[i], x[stride + i], x[2 * stride + i]};
}

double distance(const Disc& a, const Disc& b) {
  return std::hypot(static_cast<double>(a.x) - static_cast<double>(b.x),
                    static_cast<double>(a.y) - static_cast<double>(b.y));
}

/// The radius that a disc's centre needs to hold another.
double needed(const Disc& disc, const Disc& held) {
  return distance(disc, held) + static_cast<double>(held.radius);
}

/// A window, and all inner discs above it.
struct Shown {
  std::uint32_t begin;  ///< its first disc's number
  std::vector<Disc> above;
};

/// The tree of one level.
class LevelTree {
 public:
  LevelTree(const Look& look, std::uint32_t level)
      : look_(look), level_(level), tree_(look.arrays().trees[look.root(level)]), cut_(look.cut(level)) {
    const Root& root = look.arrays().roots[look.root(level)];
    std::vector<Disc> above = {{root.x, root.y, root.radius}};
    visit(tree_.top, above);
  }

  /// That every disc can be found: its own window's inner discs hold it. The last eight may be in several windows, whose
  /// own discs are not told apart, and are found in any.
  void verify_nesting() const {
    const std::uint32_t last = cut_.count < block_width ? 0 : cut_.count - block_width;
    for (std::size_t i = 0; i < windows_.size(); ++i) {
      const std::uint32_t begin = windows_[i].begin;
      const std::uint32_t end = i + 1 < windows_.size() ? windows_[i + 1].begin : last;
      if (end < begin || end > begin + block_width || (end == begin && begin != last))
        return look_.say("nodes", level_,
                         "window " + std::to_string(i) + " is at disc " + std::to_string(begin) +
                             ", the next one at " + std::to_string(end));
      for (std::uint32_t disc = begin; disc < std::min(end, last); ++disc)
        if (!is_held(windows_[i], disc)) say_lost(disc);
    }
    for (std::uint32_t disc = last; disc < cut_.count; ++disc)
      if (std::none_of(windows_.begin(), windows_.end(), [&](const Shown& window) {
            return disc - window.begin < block_width && is_held(window, disc);
          }))
        say_lost(disc);
  }

 private:
  Disc disc(std::uint32_t i) const { return {cut_.x[i], cut_.y[i], cut_.radius[i]}; }

  void visit(std::uint32_t node, std::vector<Disc>& above) {
    const float* nodes = look_.arrays().nodes.data();
    const float* x = nodes + (node & ~leaf_window);
    const bool is_window = node >= leaf_window;
    require_needed(above.back(), x, is_window ? tree_.stride : block_width);
    if (is_window) return windows_.push_back({static_cast<std::uint32_t>(x - cut_.x), above});
    for (std::uint32_t i = 0; i < block_width && x[i] < infinity; ++i) {
      above.push_back(disc_at(x, block_width, i));
      visit(std::bit_cast<std::uint32_t>(x[3 * block_width + i]), above);
      above.pop_back();
    }
  }

  /// That a disc is no larger than eight discs below it need.
  void require_needed(const Disc& above, const float* x, std::size_t stride) const {
    double most = 0;
    for (std::uint32_t i = 0; i < block_width && x[i] < infinity; ++i)
      most = std::max(most, needed(above, disc_at(x, stride, i)));
    if (static_cast<double>(above.radius) > most * (1 + 0x1p-18) + 96 * rounding::unit_roundoff * look_.reach)
      look_.say("nodes", level_, "an inner disc at " + text_of(above) + " needs " + shortest(most) + " m");
  }

  bool is_held(const Shown& window, std::uint32_t i) const {
    const double slack = 59 * rounding::unit_roundoff * look_.reach;
    return std::all_of(window.above.begin(), window.above.end(), [&](const Disc& above) {
      return needed(above, disc(i)) + slack <= static_cast<double>(above.radius);
    });
  }

  void say_lost(std::uint32_t i) const {
    look_.say(
        "nodes", level_,
        "disc " + std::to_string(i) + " at " + text_of(disc(i)) + " is not held by the inner discs above it");
  }

  const Look& look_;
  std::uint32_t level_;
  Tree tree_;
  CutDiscs cut_;
  std::vector<Shown> windows_;  ///< from left to right
};

/// The points that hold the smallest disc of a part in place do not fit into any half of it, so that one of them is
/// sqrt(d^2 + r^2) away from the centre of a disc that holds the whole.
bool may_be_part(const Disc& part, const Disc& whole, double tolerance) {
  const double d = distance(part, whole), r = part.radius,
               limit = static_cast<double>(whole.radius) + tolerance;
  return d * d + r * r <= limit * limit;
}

void verify_parts(const Look& look, std::uint32_t level) {
  const CutDiscs parts = look.cut(level), wholes = look.cut(level - 1);
  for (std::uint32_t i = 0; i < parts.count; ++i) {
    const Disc part{parts.x[i], parts.y[i], parts.radius[i]};
    bool found = false;
    for (std::uint32_t j = 0; j < wholes.count && !found; ++j)
      found = may_be_part(part, {wholes.x[j], wholes.y[j], wholes.radius[j]}, look.tolerance());
    if (!found)
      look.say(look.set.roots_only() ? "roots" : "nodes", level,
               "disc " + std::to_string(i) + " at " + text_of(part) + " belongs to none of level " +
                   std::to_string(level - 1));
  }
}

}  // namespace

void verify_inner_discs(const Look& look, std::uint32_t level) {
  if (look.arrays().roots[look.root(level)].row != single_disc) LevelTree(look, level).verify_nesting();
}

void verify_levels(const Look& look) {
  for (std::uint32_t level = 0; level < look.levels(); ++level) {
    const std::uint32_t depth = look.set.depths()[level], count = look.cut(level).count;
    if (depth < 32 && count > std::uint64_t{1} << depth)
      look.say("depths", level, std::to_string(count) + " discs at depth " + std::to_string(depth));
    if (level == 0) continue;
    if (count < look.cut(level - 1).count)
      look.say("depths", level, std::to_string(count) + " discs, fewer than at the level before");
    verify_parts(look, level);
  }
}

/// A smallest disc's centre is within the reach, and a shape reaches no farther than its discs do.
void verify_reach(const Look& look) {
  double least = 0, most = 0;
  for (std::uint32_t level = 0; level < look.levels(); ++level) {
    const CutDiscs discs = look.cut(level);
    double extent = 0;
    for (std::uint32_t i = 0; i < discs.count; ++i) {
      const double radius = discs.radius[i], away = distance({discs.x[i], discs.y[i], 0}, {0, 0, 0});
      least = std::max(least, away);
      extent = std::max(extent, away + radius);
    }
    most = level == 0 ? extent : std::min(most, extent);
  }
  if (look.reach < least - look.tolerance() || look.reach > most + look.tolerance())
    look.say(
        "reach", Finding::no_level,
        shortest(look.reach) + " m, and its discs say " + shortest(least) + " to " + shortest(most) + " m");
}

void verify_supports(const Look& look) {
  const std::uint32_t deepest = look.levels() - 1, row = look.arrays().roots[look.root(deepest)].row;
  if (row < first_row) return;
  const CutDiscs discs = look.cut(deepest);
  const Supports expected = supports(discs.x, discs.y, discs.radius, discs.count, look.reach);
  const float* stored = look.arrays().support.data() + std::size_t{row} * support_stride;
  for (std::uint32_t k = 0; k < support_stride; ++k)
    look.compare("support", deepest, "number " + std::to_string(k), static_cast<double>(stored[k]),
                 static_cast<double>(expected[k]));
}

}  // namespace bch::verification
