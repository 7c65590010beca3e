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
inline SpacePoint unit_of(const SpacePoint& offset) noexcept {
  const double length = std::sqrt(dot(offset, offset));
  return length > 0 ? SpacePoint{offset.x / length, offset.y / length, offset.z / length}
                    : SpacePoint{1, 0, 0};
}

/// Represents a sphere of an agent: relative to the agent's position, in the world's axes.
struct AgentSphere {
  SpacePoint centre;
  double radius;

  AgentSphere(const BodySetView& bodies, const Agents& agents, std::uint32_t agent, std::uint32_t slot)
      : AgentSphere(sphere_of(bodies.record(agents.shape[agent]), slot), rotation(agents.heading[agent])) {}
  AgentSphere(const Sphere& own, const Rotation& heading) {
    const auto [c, s] = heading;
    const double x = own.x, y = own.y;
    centre = {c * x - s * y, s * x + c * y, double{own.z}};
    radius = double{own.radius};
  }
  /// Returns the point of the sphere that is farthest along a unit vector, or with a sign of -1 against it.
  Vec3 end(const SpacePoint& unit, double sign) const { return rounded(centre + sign * radius * unit); }
};

/// Represents two agents with bodies, of which A has the lower index, by where they are in the world.
class AgentPair {
 public:
  AgentPair(const BodySetView& bodies, const Agents& agents, std::uint32_t a, std::uint32_t b)
      : record_a_(bodies.record(agents.shape[a])),
        record_b_(bodies.record(agents.shape[b])),
        heading_a_(rotation(agents.heading[a])),
        heading_b_(rotation(agents.heading[b])),
        between_{agents.x[b] - agents.x[a], agents.y[b] - agents.y[a],
                 agents.z.empty() ? 0 : agents.z[b] - agents.z[a]} {}

  /// Represents a sphere of either agent, each relative to its own agent's position, and where they face each other.
  class Spheres {
   public:
    /// Returns the unit vector from A's sphere to B's, or with a sign of -1 its opposite.
    Vec3 direction(double sign) const { return rounded(sign * unit_); }
    /// Returns the point of A's sphere that is farthest towards B's centre, and of B's.
    Vec3 end_of_a() const { return a_.end(unit_, 1); }
    Vec3 end_of_b() const { return b_.end(unit_, -1); }
    /// Returns how deep they overlap, metres; negative where they do not.
    double depth() const { return a_.radius + b_.radius - length_; }

   private:
    friend class AgentPair;
    Spheres(const AgentSphere& a, const AgentSphere& b, const SpacePoint& between) : a_(a), b_(b) {
      const SpacePoint offset = between + (b.centre - a.centre);
      length_ = std::sqrt(dot(offset, offset)), unit_ = unit_of(offset);
    }

    AgentSphere a_, b_;
    double length_;
    SpacePoint unit_;
  };
  Spheres spheres(std::uint32_t slot_a, std::uint32_t slot_b) const {
    return {{sphere_of(record_a_, slot_a), heading_a_}, {sphere_of(record_b_, slot_b), heading_b_}, between_};
  }

 private:
  const float *record_a_, *record_b_;
  const Rotation heading_a_, heading_b_;
  const SpacePoint between_;
};

}  // namespace bch::detail
