// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cmath>
#include <cstdint>

#include <bch/agents.hpp>

#include "layout/base/heading.hpp"
#include "layout/base/space_point.hpp"
#include "layout/body/body_record.hpp"

namespace bch::detail {

/// Returns a vector of length 1 along another; of no length: along x.
inline SpacePoint unit_of(const SpacePoint& way) noexcept {
  const double length = std::sqrt(dot(way, way));
  return length > 0 ? SpacePoint{way.x / length, way.y / length, way.z / length} : SpacePoint{1, 0, 0};
}

/// Represents a sphere of an agent: relative to the agent's position, in the world's axes.
struct AgentSphere {
  SpacePoint centre;
  double radius;

  AgentSphere(const BodySetView& bodies, const Agents& agents, std::uint32_t agent, std::uint32_t slot) {
    const Sphere own = sphere_of(bodies.record(agents.shape[agent]), slot);
    const auto [c, s] = rotation(agents.heading[agent]);
    const double x = own.x, y = own.y;
    centre = {c * x - s * y, s * x + c * y, double{own.z}};
    radius = double{own.radius};
  }
  /// Returns the point of the sphere that is farthest along a unit vector, or with a sign of -1 against it.
  Vec3 end(const SpacePoint& unit, double sign) const { return rounded(centre + sign * radius * unit); }
};

}  // namespace bch::detail
