// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cmath>
#include <cstdint>

#include <bch/agents.hpp>

#include "kernel/body/sphere_test.hpp"
#include "layout/base/heading.hpp"
#include "layout/base/space_point.hpp"
#include "layout/body/body_record.hpp"

namespace bch::detail {

/// Holds an upright cylinder with room for spheres.
struct Cylinder {
  double x, y, radius, bottom, top;
};

/// Places B in A's frame as layout/base/rounding.hpp has it, and rotates displacements into that frame.
class SpaceFrame {
 public:
  SpaceFrame(const Agents& agents, std::uint32_t a, std::uint32_t b) : of_a_(unit_vector(agents.heading[a])) {
    const auto [cosine, sine] = unit_vector(agents.heading[b]);
    const Vec2 at = turned(agents.x[b] - agents.x[a], agents.y[b] - agents.y[a]);
    const double dz = agents.z.empty() ? 0 : agents.z[b] - agents.z[a];
    b_in_a_ = {
        {of_a_.cosine * cosine + of_a_.sine * sine, of_a_.cosine * sine - of_a_.sine * cosine, at.x, at.y},
        static_cast<float>(dz)};
  }

  SpacePoint way(double x, double y, double z) const {
    const Vec2 flat = turned(x, y);
    return {double{flat.x}, double{flat.y}, static_cast<double>(static_cast<float>(z))};
  }
  Sphere placed(const Sphere& s) const {
    const auto [x, y, z, radius] = detail::placed<float>(b_in_a_, {s.x, s.y, s.z, s.radius});
    return {x, y, z, radius};
  }
  Cylinder placed(const Cylinder& c) const {
    const auto [x, y] = b_in_a_.ground.in_lanes<double>().apply(c.x, c.y);
    const double z = b_in_a_.tz;
    return {x, y, c.radius, z + c.bottom, z + c.top};
  }
  const Transform& ground() const { return b_in_a_.ground; }
  double distance() const {
    const auto [ground, z] = b_in_a_;
    return std::abs(double{ground.tx}) + std::abs(double{ground.ty}) + std::abs(double{z});
  }

 private:
  Vec2 turned(double x, double y) const {
    const float to_x = static_cast<float>(x), to_y = static_cast<float>(y);
    return {of_a_.cosine * to_x + of_a_.sine * to_y, of_a_.cosine * to_y - of_a_.sine * to_x};
  }

  UnitVector of_a_;
  SpaceTransformOf<float> b_in_a_;
};

inline Cylinder whole_of(const float* record) {
  const BodyHeader& h = header_of(record);
  return {double{h.x}, double{h.y}, double{h.radius}, double{h.bottom}, double{h.top}};
}

inline Cylinder node_of(const float* record, std::uint32_t leaf) {
  const std::size_t stride = header_of(record).node_stride;
  const float* const x = record + record_nodes + leaf;
  return {double{x[0]}, double{x[stride]}, double{x[2 * stride]}, double{x[3 * stride]},
          double{x[4 * stride]}};
}

}  // namespace bch::detail
