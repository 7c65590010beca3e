// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/clearance_reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "layout/base/heading.hpp"
#include "layout/base/rounding.hpp"

namespace bch::baselines {
namespace {

constexpr std::uint32_t none = 0xffffffff;

float gap(const Step& at, float factor) noexcept {
  return std::sqrt(at.x * at.x + at.y * at.y) * factor - at.radius_sum;
}

/// The least gap so far; of equal ones the first.
struct Nearest {
  double limit;
  float gap = std::numeric_limits<float>::infinity();
  std::uint32_t a = none, b = none;
  Step at = {};

  void take(std::uint32_t of_a, std::uint32_t of_b, const Step& step) noexcept {
    const float value = baselines::gap(step, 1 - 0x1p-20f);
    if (static_cast<double>(value) > limit || std::tie(gap, a, b) <= std::tie(value, of_a, of_b)) return;
    gap = value, a = of_a, b = of_b, at = step;
  }
};

Vec2 direction(const Agents& agents, Pair pair, const Step& at) {
  const double x = at.x, y = at.y;
  const double sign = pair.first <= pair.second ? 1 : -1;
  if (x == 0 && y == 0) return {static_cast<float>(sign), 0};
  const detail::UnitVector heading = detail::unit_vector(agents.heading[std::min(pair.first, pair.second)]);
  const double c = heading.cosine, s = heading.sine;
  const double world_x = c * x - s * y, world_y = s * x + c * y;
  const double scale = sign / std::sqrt(world_x * world_x + world_y * world_y);
  return {static_cast<float>(scale * world_x), static_cast<float>(scale * world_y)};
}

}  // namespace

Clearance at_least_zero(const Clearance& clearance) {
  return clearance.distance <= 0 ? Clearance{0, {0, 0}, none, none} : clearance;
}

Clearance ClearanceReference::query(const Agents& agents, Pair pair, double max_distance, Method method) {
  const auto [first, second] = std::minmax(pair.first, pair.second);
  const CutTrees::Tree &a = trees_.tree(agents, first), &b = trees_.tree(agents, second);
  const FloatPlacement place = float_placement(agents, pair);
  Nearest nearest{max_distance};
  if (method == Method::brute_force) {
    for (std::uint32_t i = 0; i < a.discs.size(); ++i)
      for (std::uint32_t j = 0; j < b.discs.size(); ++j)
        nearest.take(i, j, step(place, a.discs[i], b.discs[j]));
  } else {
    // Twice what discs below may have a smaller gap than the one above, by rounding.
    const float slack = 0x1p-18f * (a.max_extent + b.max_extent);
    const float most = detail::rounding::round_up(std::min(max_distance, 1e30));
    search(
        place, a.nodes.data(), b.nodes.data(), open_,
        [slack](const Step& at) { return gap(at, 1 - 0x1p-18f) - slack; },
        [&] { return std::min(most, nearest.gap); },
        [&](std::uint32_t i, std::uint32_t j, const Step& at) { nearest.take(i, j, at); });
  }
  if (nearest.a == none) return {nearest.gap, {0, 0}, none, none};
  const Vec2 towards = direction(agents, pair, nearest.at);
  if (pair.first <= pair.second) return {nearest.gap, towards, nearest.a, nearest.b};
  return {nearest.gap, towards, nearest.b, nearest.a};
}

bool ClearanceReference::within(const Agents& agents, Pair pair, double distance, Method method) {
  const auto [first, second] = std::minmax(pair.first, pair.second);
  const CutTrees::Tree &a = trees_.tree(agents, first), &b = trees_.tree(agents, second);
  const FloatPlacement place = float_placement(agents, pair);
  const float gap = detail::rounding::round_up(std::min(distance, 1e10) * (1 + 0x1p-19));
  const auto is_near = [](const Step& at, float most) {
    const float sum = at.radius_sum * (1 + 0x1p-19f) + most;
    return at.x * at.x + at.y * at.y <= sum * sum;
  };
  if (method == Method::brute_force) {
    for (const Disc& of_a : a.discs)
      for (const Disc& of_b : b.discs)
        if (is_near(step(place, of_a, of_b), gap)) return true;
    return false;
  }
  // What bounds say by being 0: that they may be near. One hit ends the search.
  bool found = false;
  const float bound_gap = gap + 0x1p-17f * (a.max_extent + b.max_extent + gap);
  search(
      place, a.nodes.data(), b.nodes.data(), open_,
      [&](const Step& at) { return is_near(at, bound_gap) ? 0.0f : 1.0f; },
      [&] { return found ? -1.0f : 0.0f; },
      [&](std::uint32_t, std::uint32_t, const Step& at) { found = found || is_near(at, gap); });
  return found;
}

}  // namespace bch::baselines
