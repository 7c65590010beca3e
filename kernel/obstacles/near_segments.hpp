// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <bch/geometry.hpp>
#include <bch/query.hpp>

#include "kernel/obstacles/obstacle_arguments.hpp"
#include "kernel/simd/heights_meet.hpp"
#include "layout/base/heading.hpp"

namespace bch::detail {

/// Holds the position and rotation of an agent.
struct ObstaclePlace {
  double x, y;
  Rotation turn;

  struct Vector {
    double x, y;
  };
  /// Rotates a vector from the agent's frame into the world; turned_back() is the inverse.
  Vector turned(double at_x, double at_y) const noexcept {
    return {turn.cosine * at_x - turn.sine * at_y, turn.sine * at_x + turn.cosine * at_y};
  }
  Vector turned_back(double at_x, double at_y) const noexcept {
    return {turn.cosine * at_x + turn.sine * at_y, turn.cosine * at_y - turn.sine * at_x};
  }
};

/// Returns the vector from a point to the nearest one of a segment, in the agent's frame.
inline ObstaclePlace::Vector to_nearest_point(const LocalSegment& segment, double x, double y) noexcept {
  const double along = segment.along(x, y), aside = -segment.across(x, y);
  const double forward = std::clamp(along, segment.from, segment.to) - along;
  return {forward * segment.x - aside * segment.y, forward * segment.y + aside * segment.x};
}

/// Holds the heights of an agent above its ground, and that of the ground, metres.
struct StandingBody {
  Heights heights = {-__builtin_inff(), __builtin_inff()};
  double ground = 0;
};

/// Represents a query: a disc in an agent's frame.
struct NearQuery {
  ObstaclePlace place;
  Vec2 centre;
  double distance;
  StandingBody body;
};

/// Finds the segments and areas of obstacles that are near a disc, and reuses its memory.
class NearSegments {
 public:
  NearSegments(const Implementation& implementation, const ObstacleView& obstacles) noexcept
      : implementation_(implementation), obstacles_(obstacles) {}

  const ObstacleView& obstacles() const noexcept { return obstacles_; }

  /// Finds the segments within each of many discs, for take(). The queries must outlive its calls.
  void prepare(std::span<const NearQuery> queries);
  /// Returns the segments of one of the queries of prepare(). From then on, obstacles above or below its body are left out.
  std::span<LocalSegment> take(std::size_t query);

  /// Finds all segments within a distance of a point of the agent's frame, by ascending number, so that those of an obstacle are
  /// consecutive.
  std::span<LocalSegment> find(const ObstaclePlace& place, Vec2 centre, double distance);
  /// Finds at least those within a distance of a point that moves by `displacement` (in the world), in the same order.
  std::span<LocalSegment> find_along(const ObstaclePlace& place, Vec2 centre, double distance,
                                     ObstaclePlace::Vector displacement);
  std::span<LocalSegment> found() const noexcept { return found_; }

  /// Returns a distance from a point of the agent's frame within which find() finds the nearest segment and hardly any other;
  /// infinity if there is no segment.
  double nearest_distance(const ObstaclePlace& place, Vec2 centre);
  /// Calls take(segment) for all segments that are nearer to a point of the agent's frame than `limit`, and for few others. Those
  /// of near boxes come first. `limit` is limit_of() a distance, or infinity; take() may lower it.
  template <class Take>
  void visit_near(const ObstaclePlace& place, Vec2 point, const double& limit, const Take& take) {
    const auto [x, y] = in_world(place, point);
    nearest_boxes_.visit(obstacles_.segment_tree, x, y, limit, [&](std::uint32_t slot) {
      if (is_level(obstacles_.segments[slot].obstacle, body_)) take(put(place, slot, visited_));
    });
  }
  static double limit_of(const ObstaclePlace& place, double distance) noexcept;

  /// Calls visit(segments, obstacle) for every obstacle of the found segments, until it returns true. Returns: whether it did.
  template <class Visit>
  bool any_obstacle(const Visit& visit) {
    for (std::size_t begin = 0, end; begin < found_.size(); begin = end) {
      const std::uint32_t obstacle = found_[begin].obstacle;
      for (end = begin + 1; end < found_.size() && found_[end].obstacle == obstacle;) ++end;
      if (visit(std::span<const LocalSegment>(found_).subspan(begin, end - begin), obstacle)) return true;
    }
    return false;
  }

  /// Returns the areas that contain a point of the agent's frame, ascending: by the parity of their segments that a ray crosses,
  /// one ray for all areas. An area whose border is next to the point may be missing or not. Valid until the next call.
  std::span<const std::uint32_t> areas_containing(const ObstaclePlace& place, Vec2 point);

 private:
  /// Finds the boxes of a tree that overlap `boxes_`, level by level, and writes them to hits_, query after query. Returns: how
  /// many there are.
  std::uint32_t descend(const BoxTreeView& tree);
  /// Finds the boxes that overlap one box. Valid until the next call.
  std::span<const BoxHit> overlapping(const BoxTreeView& tree, const Box& box);
  static ObstaclePlace::Vector in_world(const ObstaclePlace& place, Vec2 point) noexcept {
    const auto [x, y] = place.turned(double{point.x}, double{point.y});
    return {place.x + x, place.y + y};
  }
  /// Returns whether a body is neither above nor below an obstacle.
  bool is_level(std::uint32_t obstacle, const StandingBody& body) const noexcept {
    if (obstacles_.heights == nullptr) return true;
    const auto [bottom, top] = obstacles_.heights[obstacle];
    return heights_meet(bottom, top, body.heights, body.ground);
  }
  /// Transforms the segment in a slot into the frame of an agent. (It writes in place: copying a result would wait for it.)
  [[gnu::always_inline]] const LocalSegment& put(const ObstaclePlace& place, std::uint32_t slot,
                                                 LocalSegment& to) const noexcept {
    const WorldSegment& world = obstacles_.segments[slot];
    const double dx = world.ax - place.x, dy = world.ay - place.y;
    const double from = dx * world.x + dy * world.y;
    const ObstaclePlace::Vector along = place.turned_back(world.x, world.y);
    to = {along.x,
          along.y,
          dy * world.x - dx * world.y,
          from,
          from + world.length,
          relative_slack * (std::abs(dx) + std::abs(dy) + world.length),
          slot,
          world.number,
          world.obstacle};
    return to;
  }
  /// Sorts found segments by their numbers.
  std::span<LocalSegment> sorted(std::span<LocalSegment> segments);

  /// Represents a point in the world by the agent's position and the vector from there.
  struct AgentPoint {
    double x, y, displacement_x, displacement_y;
    friend bool operator==(const AgentPoint&, const AgentPoint&) = default;
  };

  const Implementation& implementation_;
  const ObstacleView& obstacles_;
  std::vector<std::uint32_t> about_, areas_;
  std::optional<AgentPoint> of_point_;  ///< the point that areas_ contain
  std::vector<Box> boxes_;
  std::vector<BoxHit> hits_, next_;
  NearestBoxes nearest_boxes_;
  std::vector<LocalSegment> memory_, prepared_;  ///< of find() and of prepare()
  LocalSegment visited_;                         ///< by visit_near()
  std::vector<std::uint32_t> prepared_end_;  ///< by query: where the segments of the queries before it end
  std::span<LocalSegment> found_;
  std::span<const NearQuery> queries_;  ///< of prepare()
  StandingBody body_;                   ///< of the last query of take()
};

/// Tests whether an area contains points that its segments do not touch. The first point is compared with the whole area,
/// the others by the vector from the first.
class AreaSide {
 public:
  AreaSide(NearSegments& near, const ObstaclePlace& place, std::span<const LocalSegment> segments,
           std::uint32_t obstacle) noexcept
      : near_(near), place_(place), segments_(segments), obstacle_(obstacle) {}

  bool contains(Vec2 point);

 private:
  NearSegments& near_;
  const ObstaclePlace& place_;
  std::span<const LocalSegment> segments_;
  std::uint32_t obstacle_;
  bool is_known_ = false, first_is_contained_ = false;
  ObstaclePlace::Vector first_{};
};

}  // namespace bch::detail
