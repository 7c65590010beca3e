// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/penetration_reference.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "layout/base/heading.hpp"
#include "layout/base/rounding.hpp"

namespace bch::baselines {
namespace {

struct Vector {
  double x, y;
};

/// The largest extent of an agent's discs along a direction of the world, from its position on.
double support(const CutLists& cuts, const Agents& agents, std::uint32_t agent, Vector along) {
  const detail::Rotation turn = detail::rotation(agents.heading[agent]);
  const auto x = static_cast<float>(turn.cosine * along.x + turn.sine * along.y);
  const auto y = static_cast<float>(turn.cosine * along.y - turn.sine * along.x);
  float largest = -HUGE_VALF;
  for (const Disc& disc : cuts.of(agents, agent))
    largest = std::max(largest, disc.x * x + disc.y * y + disc.radius);
  return static_cast<double>(largest);
}

/// Returns how far `mover` has to move until it is before `other`, without slack.
double depth_along(const CutLists& cuts, const Agents& agents, std::uint32_t mover, std::uint32_t other,
                   Vector along) {
  const double dx = agents.x[other] - agents.x[mover], dy = agents.y[other] - agents.y[mover];
  return support(cuts, agents, other, along) + support(cuts, agents, mover, {-along.x, -along.y}) +
         (dx * along.x + dy * along.y);
}

PenetrationDepth with_slack(const CutLists& cuts, const Agents& agents, Pair pair, double least,
                            Vector along) {
  const double max_extent = static_cast<double>(cuts.max_extent(agents, std::min(pair.first, pair.second))) +
                            static_cast<double>(cuts.max_extent(agents, std::max(pair.first, pair.second)));
  const double depth =
      (least + 40 * detail::rounding::unit_roundoff * max_extent) * (1 + 4 * detail::rounding::unit_roundoff);
  return {depth > 0 ? detail::rounding::round_up(depth) : 0.0f, along.x, along.y};
}

}  // namespace

PenetrationDepth penetration_along(const CutLists& cuts, const Agents& agents, Pair pair, Vec2 direction) {
  const double x = direction.x, y = direction.y, length = std::sqrt(x * x + y * y);
  const Vector along{x / length, y / length};
  return with_slack(cuts, agents, pair, depth_along(cuts, agents, pair.first, pair.second, along), along);
}

PenetrationDepth penetration(const CutLists& cuts, const Agents& agents, Pair pair, std::uint32_t k) {
  const auto [a, b] = std::minmax(pair.first, pair.second);
  double least = HUGE_VAL;
  Vector best{0, 0};
  for (std::uint32_t i = 0; i < k / 2; ++i) {
    const detail::Rotation turn = detail::rotation(2 * std::numbers::pi * i / k);
    for (const double sign : {1.0, -1.0}) {
      const Vector along{sign * turn.cosine, sign * turn.sine};
      const double each = depth_along(cuts, agents, a, b, along);
      if (each < least) least = each, best = along;
    }
  }
  if (pair.first != a) best = {-best.x, -best.y};
  return with_slack(cuts, agents, pair, least, best);
}

}  // namespace bch::baselines
