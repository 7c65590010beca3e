// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/time_of_impact_reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "layout/base/heading.hpp"

namespace bch::baselines {
namespace {

constexpr float never = std::numeric_limits<float>::infinity();

/// A's displacement relative to B, in A's frame.
struct RelativeMotion {
  float x, y;
};

/// Returns the time at which two discs of the cuts touch; kernel/distance/time_of_impact_measure.hpp derives
/// the formula.
float contact(const Step& at, RelativeMotion motion) noexcept {
  const double x = at.x, y = at.y, vx = motion.x, vy = motion.y, sum = at.radius_sum;
  const double square = x * x + y * y;
  if (square <= sum * sum * (1 + 0x1p-22)) return 0;
  const double radius = sum + 0x1p-20 * std::sqrt(square);
  const double towards = x * vx + y * vy, aside = x * vy - y * vx;
  const double under_root = radius * radius * (vx * vx + vy * vy) - aside * aside;
  if (towards <= 0 || under_root < 0) return never;
  const double left = square - radius * radius;
  if (left <= 0) return 0;
  const double time = left / (towards + std::sqrt(under_root)) * (1 - 0x1p-22);
  return time <= 1 ? static_cast<float>(time) : never;
}

/// A time before which nothing below two discs touches, or never: by how far the moving disc's front has to
/// go, and by how near it comes until `most`.
float earliest(const Step& at, RelativeMotion motion, float slack, float most) noexcept {
  const double x = at.x, y = at.y, vx = motion.x, vy = motion.y;
  const double radius =
      static_cast<double>(at.radius_sum) + static_cast<double>(slack) + 0x1p-17 * (std::abs(x) + std::abs(y));
  const double square = vx * vx + vy * vy, towards = x * vx + y * vy;
  const double nearest = square > 0 ? std::clamp(towards / square, 0.0, static_cast<double>(most)) : 0;
  const double left_x = x - nearest * vx, left_y = y - nearest * vy;
  if (left_x * left_x + left_y * left_y > radius * radius) return never;
  if (!(square > 0)) return 0;
  const double length = std::sqrt(square);
  return static_cast<float>(std::max(0.0, (towards / length - radius) / length * (1 - 0x1p-20)));
}

}  // namespace

float TimeOfImpactReference::query(const Agents& agents, Pair pair, double x, double y, Method method) {
  const auto [first, second] = std::minmax(pair.first, pair.second);
  const CutTrees::Tree &a = trees_.tree(agents, first), &b = trees_.tree(agents, second);
  const FloatPlacement place = float_placement(agents, pair);
  const detail::UnitVector heading = detail::unit_vector(agents.heading[first]);
  const double sign = pair.first <= pair.second ? 1 : -1;
  const auto dx = static_cast<float>(sign * x), dy = static_cast<float>(sign * y);
  if (dx == 0 && dy == 0) return any_hit(cuts_, agents, pair) ? 0 : never;
  const RelativeMotion motion{heading.cosine * dx + heading.sine * dy,
                              heading.cosine * dy - heading.sine * dx};
  float soonest = never;
  if (method == Method::brute_force) {
    for (const Disc& p : a.discs)
      for (const Disc& q : b.discs) soonest = std::min(soonest, contact(step(place, p, q), motion));
    return soonest;
  }
  const float slack = 0x1p-17f * (a.max_extent + b.max_extent);
  const auto most = [&] { return std::min(soonest, 1.0f); };
  search(
      place, a.nodes.data(), b.nodes.data(), open_,
      [&](const Step& at) { return earliest(at, motion, slack, most()); }, most,
      [&](std::uint32_t, std::uint32_t, const Step& at) {
        soonest = std::min(soonest, contact(at, motion));
      });
  return soonest;
}

}  // namespace bch::baselines
