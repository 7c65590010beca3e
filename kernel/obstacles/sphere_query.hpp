// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>

#include "kernel/obstacles/body_query.hpp"
#include "layout/body/body_record.hpp"

namespace bch::detail {

/// Holds the least gap so far between a sphere of a body and an obstacle.
struct SphereGap {
  double gap;              ///< metres; if nothing was found, the limit
  std::uint32_t slot = 0;  ///< of the sphere
  std::uint32_t obstacle = 0;
  LocalSegment segment = {};
  bool is_found = false;
  bool is_inside = false;  ///< the area contains the centre, as seen from above; `segment` is not set then
};

/// Compares the spheres of bodies with obstacles: upright solids on a line or over an area, from bottom to top. With d the distance
/// of a sphere's centre from the line, or 0 in the area, and h its height above or below the solid, or 0,
///
///     gap = sqrt(d^2 + h^2) - (r + slack)
///
/// in double, where slack is that of LocalSegment plus 2^-50 of the ground's height. Radii are enlarged by more than the sums round, so
/// that a gap is never larger than that of the given spheres.
class SphereQuery : public BodyQuery {
 public:
  SphereQuery(const Implementation& implementation, const BodySetView& bodies, const Agents& agents,
              const ObstacleView& obstacles) noexcept
      : BodyQuery(implementation, bodies.ground, agents, obstacles, false, true),
        bodies_(bodies),
        agents_(agents) {}

  /// Calls found(obstacle) once for each obstacle that has a gap of at most 0 from the body of a prepared agent, until it returns
  /// false.
  template <class Found>
  void visit_hits(std::uint32_t agent, const Found& found) {
    if (!begin(agent)) return;
    const auto hits = [&](std::span<const LocalSegment> segments, std::uint32_t obstacle) {
      SphereGap nearest{0};
      improve(segments, obstacle, nearest);
      return nearest.is_found;
    };
    const bool stop =
        near().any_obstacle([&](std::span<const LocalSegment> segments, std::uint32_t obstacle) {
          return hits(segments, obstacle) && !found(obstacle);
        });
    if (!stop) visit_areas_beyond(*body_, [&](std::uint32_t area) { return !hits({}, area) || found(area); });
  }

  /// Finds the least gap, if at most `limit`, metres, of a prepared agent.
  SphereGap nearest(std::uint32_t agent, double limit);
  bool is_within(std::uint32_t agent, double distance) { return nearest(agent, distance).is_found; }

 private:
  /// Selects an agent, and the segments near it. Returns: false if it was left out.
  bool begin(std::uint32_t agent) {
    body_ = body(agent);
    if (body_ == nullptr) return false;
    near_body(*body_);
    record_ = bodies_.record(body_->shape);
    ground_ = agents_.z.empty() ? 0 : agents_.z[agent];
    return true;
  }
  /// Improves `nearest` by an obstacle. An area without segments contains all of the body, as seen from above.
  void improve(std::span<const LocalSegment> segments, std::uint32_t obstacle, SphereGap& nearest);
  /// Returns how far heights of the body are above or below an obstacle, 0 if they meet.
  double vertical_gap(float bottom, float top, std::uint32_t obstacle) const noexcept;

  const BodySetView& bodies_;
  const Agents& agents_;
  const PlacedBody* body_ = nullptr;
  const float* record_ = nullptr;
  double ground_ = 0;
};

}  // namespace bch::detail
