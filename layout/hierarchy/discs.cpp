// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/hierarchy/discs.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "layout/base/number_class.hpp"
#include "layout/base/rounding.hpp"
#include "layout/base/shortest.hpp"
#include "layout/hierarchy/builder.hpp"
#include "layout/hierarchy/disc_box.hpp"

namespace bch::detail {
namespace {

/// Returns the radius about (x, y) that holds discs.
double radius_about(double x, double y, std::span<const Disc> discs) noexcept {
  double radius = 0;
  for (const Disc& disc : discs)
    radius = std::max(radius, length(double{disc.x} - x, double{disc.y} - y) + double{disc.radius});
  return radius;
}

/// Returns where a convex function is least: the interval shrinks to a ten-millionth.
template <class Of>
double least_at(double low, double high, Of of) noexcept {
  for (int i = 0; i < 40; ++i) {
    const double third = (high - low) / 3, one = low + third, other = high - third;
    of(one) <= of(other) ? high = other : low = one;
  }
  return low + (high - low) / 2;
}

/// Returns the smallest disc that holds discs, but for the margin. The radius about a point is convex, also where it is the least for a given x.
Disc smallest_disc(std::span<const Disc> discs, double margin) {
  Disc disc = discs[0];
  if (discs.size() > 1) {
    DiscBox box;
    for (const Disc& each : discs) box.add(each);
    const auto best_y = [&](double x) {
      return least_at(box.low_y, box.high_y, [&](double y) { return radius_about(x, y, discs); });
    };
    const double x =
        least_at(box.low_x, box.high_x, [&](double at) { return radius_about(at, best_y(at), discs); });
    disc.x = static_cast<float>(x), disc.y = static_cast<float>(best_y(x));
  }
  disc.radius = rounding::round_up(radius_about(disc.x, disc.y, discs) * (1 + 0x1p-48) + margin);
  return disc;
}

/// Returns how many of the discs go to the first child, so that the larger half is as small as can be.
std::size_t best_split(std::span<const Disc> discs) {
  std::vector<double> of_rest(discs.size());
  DiscBox rest, first;
  for (std::size_t i = discs.size(); i-- > 1;) rest.add(discs[i]), of_rest[i] = rest.size();
  std::size_t best = 1;
  double least = HUGE_VAL;
  for (std::size_t i = 1; i < discs.size(); ++i) {
    first.add(discs[i - 1]);
    const double size = std::max(first.size(), of_rest[i]);
    if (size < least) least = size, best = i;
  }
  return best;
}

/// Inner nodes hold the discs with room to spare; see layout/base/rounding.hpp, VIII.
void add_nodes(std::span<const Disc> discs, Hierarchy& hierarchy) {
  constexpr double of_leaves = rounding::query_margin,
                   of_others = of_leaves + rounding::conservative_margin + 4 * rounding::unit_roundoff;
  const std::size_t node = hierarchy.nodes.size();
  const bool is_leaf = discs.size() == 1;
  hierarchy.nodes.push_back({smallest_disc(discs, (is_leaf ? of_leaves : of_others) * hierarchy.max_extent)});
  if (is_leaf) return;
  const std::size_t first = best_split(discs);
  add_nodes(discs.first(first), hierarchy);
  hierarchy.nodes[node].second_child = static_cast<std::uint32_t>(hierarchy.nodes.size());
  add_nodes(discs.subspan(first), hierarchy);
}

}  // namespace

Hierarchy disc_hierarchy(std::span<const Disc> discs) {
  constexpr std::size_t most = 4096;
  if (discs.empty() || discs.size() > most)
    throw std::invalid_argument("shape: " + std::to_string(discs.size()) + " discs, not 1 to " +
                                std::to_string(most));
  double max_extent = 0;
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const auto& [x, y, radius] = discs[i];
    if (!(radius > 0) || !is_finite(x) || !is_finite(y) || !is_finite(radius))
      throw std::invalid_argument("shape: disc " + std::to_string(i) + " of " + shortest(radius) + " m at (" +
                                  shortest(x) + ", " + shortest(y) + ") m");
    max_extent = std::max(max_extent, length(x, y) + double{radius});
  }
  require_extent(max_extent);
  Hierarchy hierarchy;
  hierarchy.max_extent = max_extent;
  add_nodes(discs, hierarchy);
  return hierarchy;
}

}  // namespace bch::detail
