// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cmath>
#include <cstdint>

#include <bch/agents.hpp>

#include "layout/base/heading.hpp"
#include "layout/body/body_record.hpp"

namespace bch::detail {

struct SpaceVector {
  double x, y, z;
};

inline Vec3 rounded(const SpaceVector& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Returns a vector of length 1 along another; of no length: along x.
inline SpaceVector unit_of(const SpaceVector& way) noexcept {
  const double length = std::sqrt((way.x * way.x + way.y * way.y) + way.z * way.z);
  return length > 0 ? SpaceVector{way.x / length, way.y / length, way.z / length} : SpaceVector{1, 0, 0};
}

/// Represents a sphere of an agent: relative to the agent's position, in the world's axes.
struct AgentSphere {
  SpaceVector centre;
  double radius;

  AgentSphere(const BodySetView& bodies, const Agents& agents, std::uint32_t agent, std::uint32_t slot) {
    const Sphere own = sphere_of(bodies.record(agents.shape[agent]), slot);
    const auto [c, s] = rotation(agents.heading[agent]);
    const double x = own.x, y = own.y;
    centre = {c * x - s * y, s * x + c * y, double{own.z}};
    radius = double{own.radius};
  }
  /// Returns the point of the sphere that is farthest along a unit vector, or with a sign of -1 against it.
  Vec3 end(const SpaceVector& unit, double sign) const {
    const double r = sign * radius;
    return rounded({centre.x + r * unit.x, centre.y + r * unit.y, centre.z + r * unit.z});
  }
};

}  // namespace bch::detail
