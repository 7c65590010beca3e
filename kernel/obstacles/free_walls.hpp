// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "kernel/obstacles/body_query.hpp"
#include "kernel/penetration/free_bodies.hpp"
#include "kernel/penetration/free_way.hpp"

namespace bch::detail {

/// Is what a FreeWaySearch knows of obstacles: the segments about an agent. The longer its ways, the more of them it takes. `Query` is
/// BodyQuery or SphereQuery, and asks about a copy of the agent, which moves.
template <class Query, class Source>
class ObstacleWalls {
 public:
  /// make(agents) returns the query of an agent. (It refers to a member, so walls stay where they are made.)
  template <class Make>
  ObstacleWalls(const Source& source, const Make& make) : source_(source), query_(make(copy_)) {}

  void begin(std::uint32_t agent) {
    agent_ = agent;
    moved_.clear();
    moved_.add(source_.agents(), agent);
    copy_ = moved_.agents();
    take(source_.max_extent(agent));
    has_grown_ = false;
  }
  /// Takes more segments unless it knows all that a way to this place may come to.
  void know(float place) {
    if (double{place} > limit_ && limit_ <= farthest) take(2 * limit_);
  }
  /// Returns whether it has taken more segments since the last call.
  bool has_grown() { return std::exchange(has_grown_, false); }
  void turn(float x, float y) { x_ = x, y_ = y, is_turned_ = false; }
  float next(float place) { return is_empty_ ? place : turned().next(place); }
  float after_gap(float place) {
    for (;;) {
      const float after = is_empty_ ? place : turned().after_gap(place);
      if (after > place && (double{after} <= limit_ || limit_ > farthest)) return after;
      // Every area ends somewhere.
      if (limit_ > farthest) return std::numeric_limits<float>::infinity();
      take(2 * limit_);
    }
  }
  FreeTouch touch(float place) { return is_empty_ ? FreeTouch{} : turned().touch(place); }
  bool are_hit(double x, double y) {
    prepare(x, y, 0);
    bool hit = false;
    query_.visit_hits(0, [&](std::uint32_t) { return hit = true, false; });
    return hit;
  }

 private:
  static constexpr double farthest = 2 * farthest_gap;  ///< metres: nothing is beyond

  FreePair& turned() {
    if (!is_turned_) search_.turn(x_, y_);
    is_turned_ = true;
    return search_;
  }
  void prepare(double x, double y, double limit) {
    moved_.move_to(x, y);
    query_.prepare(0, 1, limit, SearchMode::touching);
  }
  /// Takes all segments that ways up to a limit may come to.
  void take(double limit);
  FreeElement element(const LocalSegment& segment, double max_extent) const;
  /// Gives a wall its heights as seen from the agent's ground, not far beyond the body's own.
  void set_heights(const LocalSegment& segment, FreeElement& element) const;
  double ground() const { return source_.agents().z.empty() ? 0 : source_.agents().z[agent_]; }

  const Source& source_;
  MovedAgents moved_;
  Agents copy_;
  Query query_;
  FreePair search_;
  std::uint32_t agent_ = 0;
  float x_ = 1, y_ = 0;
  bool is_turned_ = false, is_empty_ = true, has_grown_ = false;
  double limit_ = 0;  ///< metres, up to which search_ knows all: the agent's extent times a power of two
};

template <class Query, class Source>
void ObstacleWalls<Query, Source>::take(double limit) {
  const Agents& agents = source_.agents();
  prepare(agents.x[agent_], agents.y[agent_], limit);
  limit_ = limit, has_grown_ = true, is_empty_ = true, is_turned_ = false;
  const PlacedBody* const body = query_.body(0);
  if (body == nullptr) return;
  query_.near_body(*body);
  const double within = body->outer_radius() + limit,
               max_extent = within + std::abs(double{body->centre().x}) + std::abs(double{body->centre().y});
  double slack = 0;
  const std::span<const LocalSegment> segments = query_.near().find(body->place, body->centre(), within);
  is_empty_ = segments.empty();
  if (is_empty_) return;
  begin_leaves(segments.size(), search_.b);
  for (const LocalSegment& segment : segments) {
    search_.b.add(element(segment, max_extent));
    slack = std::max(slack, segment.slack);
  }
  source_.begin_walls(search_, agent_, slack + 0x1p-50 * std::abs(ground()));
}

/// Of a segment, only what is within reach counts.
template <class Query, class Source>
FreeElement ObstacleWalls<Query, Source>::element(const LocalSegment& segment, double max_extent) const {
  const double from = std::clamp(segment.from, -max_extent, max_extent),
               to = std::clamp(segment.to, -max_extent, max_extent);
  const double middle = (from + to) / 2, half = (to - from) / 2;
  FreeElement element{static_cast<float>(middle * segment.x - segment.offset * segment.y),
                      static_cast<float>(middle * segment.y + segment.offset * segment.x),
                      0,
                      static_cast<float>(half),
                      static_cast<float>(half * segment.x),
                      static_cast<float>(half * segment.y),
                      std::numeric_limits<float>::infinity()};
  if (Source::is_in_space && query_.obstacles().heights != nullptr) set_heights(segment, element);
  return element;
}

template <class Query, class Source>
void ObstacleWalls<Query, Source>::set_heights(const LocalSegment& segment, FreeElement& element) const {
  const WorldHeights world = query_.obstacles().heights[segment.obstacle];
  const Heights body = source_.heights(agent_);
  const double low = double{body.bottom} - 1, high = double{body.top} + 1;
  const double bottom = std::clamp(world.bottom - ground(), low, high),
               top = std::clamp(world.top - ground(), low, high);
  element.z = static_cast<float>((bottom + top) / 2), element.half_z = static_cast<float>((top - bottom) / 2);
}

}  // namespace bch::detail
