// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/placement.hpp"

#include <algorithm>
#include <cmath>

#include "layout/base/heading.hpp"

namespace bch::baselines {
namespace {

/// Returns how much higher b stands than a.
double dz(const Agents& agents, std::uint32_t a, std::uint32_t b) {
  return agents.z.empty() ? 0 : agents.z[b] - agents.z[a];
}

FloatPlacement between(const Agents& agents, std::uint32_t a, std::uint32_t b, const detail::UnitVector& u,
                       const detail::UnitVector& v) {
  const float dx = static_cast<float>(agents.x[b] - agents.x[a]);
  const float dy = static_cast<float>(agents.y[b] - agents.y[a]);
  return {u.cosine * v.cosine + u.sine * v.sine, u.cosine * v.sine - u.sine * v.cosine,
          u.cosine * dx + u.sine * dy, u.cosine * dy - u.sine * dx, static_cast<float>(dz(agents, a, b))};
}

double without_dust(double value) {
  return std::abs(value) < 0x1p-100 ? 0.0 : value;
}

}  // namespace

FloatPlacement float_placement(const Agents& agents, Pair pair) noexcept {
  const auto [a, b] = std::minmax(pair.first, pair.second);
  return between(agents, a, b, detail::unit_vector(agents.heading[a]),
                 detail::unit_vector(agents.heading[b]));
}

FloatPlacement float_placement(const Agents& agents, Pair pair,
                               std::span<const detail::UnitVector> directions) noexcept {
  const auto [a, b] = std::minmax(pair.first, pair.second);
  return between(agents, a, b, directions[a], directions[b]);
}

Placement placement(const Agents& agents, Pair pair) noexcept {
  const auto [a, b] = std::minmax(pair.first, pair.second);
  const detail::Rotation u = detail::rotation(agents.heading[a]);
  const detail::Rotation v = detail::rotation(agents.heading[b]);
  const double dx = agents.x[b] - agents.x[a];
  const double dy = agents.y[b] - agents.y[a];
  return {without_dust(u.cosine * v.cosine + u.sine * v.sine),
          without_dust(u.cosine * v.sine - u.sine * v.cosine), without_dust(u.cosine * dx + u.sine * dy),
          without_dust(u.cosine * dy - u.sine * dx)};
}

Placement placement_in_space(const Agents& agents, Pair pair) noexcept {
  Placement there = placement(agents, pair);
  const auto [a, b] = std::minmax(pair.first, pair.second);
  there.z = without_dust(dz(agents, a, b));
  return there;
}

}  // namespace bch::baselines
