// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <bch/query.hpp>

#include "kernel/obstacles/near_segments.hpp"
#include "layout/base/rounding.hpp"
#include "layout/format/cut_discs.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Represents an agent's shape at its position and level.
struct PlacedBody {
  const ShapeSetView& shapes;
  ObstaclePlace place;
  std::uint32_t shape, level;
  /// Metres: segments within this distance of the outer disc were searched. The outer disc is about the root's centre
  /// and contains all discs of the cut (outer_radius()).
  double searched;
  std::size_t number;  ///< index among the bodies that were prepared

  std::uint32_t root_index() const noexcept { return shape * shapes.level_count + level; }
  const Root& root() const noexcept { return shapes.roots[root_index()]; }
  Vec2 centre() const noexcept { return {root().x, root().y}; }
  double outer_radius() const noexcept { return bch::detail::outer_radius(shapes, root_index()); }
};

/// No gap is larger, metres.
constexpr double farthest_gap = 8 * rounding::largest_position;

/// Holds the nearest obstacle of an agent.
struct NearestObstacle {
  double gap;  ///< metres; if nothing was found, the limit
  /// The nearest part of the agent. It is a segment of the outline, given by its first point. If `point` is no_point,
  /// it is instead the disc number `disc` of the agent's cut, which is the discs at its level of detail.
  std::uint32_t point = no_point, disc = 0;
  const PlacedBody* body = nullptr;
  LocalSegment segment = {};
  bool is_found = false, is_within = false;
};

/// Selects which segments are searched first: those that touch a body, or some that include the nearest one.
enum class SearchMode { touching, nearest };

/// Answers queries of agents against obstacles; it reuses its memory from agent to agent.
class BodyQuery {
 public:
  /// With `exact_leaves`, the outlines of shapes with exact leaves are tested and measured; for all other shapes,
  /// discs are. With `in_space`, obstacles above and below a body are near it, too, up to the limit of prepare().
  BodyQuery(const Implementation& implementation, const ShapeSetView& shapes, const Agents& agents,
            const ObstacleView& obstacles, bool exact_leaves, bool in_space = false) noexcept
      : implementation_(implementation),
        shapes_(shapes),
        agents_(agents),
        near_(implementation, obstacles),
        exact_leaves_(exact_leaves),
        in_space_(in_space) {}

  NearSegments& near() noexcept { return near_; }
  const ObstacleView& obstacles() const noexcept { return near_.obstacles(); }

  /// Searches segments for agents begin .. end: those that touch their outer discs, or some that include the nearest one.
  /// near_body() then returns them. Agents from which all obstacles are farther than `limit` are left out.
  void prepare(std::uint32_t begin, std::uint32_t end, double limit, SearchMode mode);

  /// Returns the segments that prepare() found for a body.
  std::span<LocalSegment> near_body(const PlacedBody& body) { return near_.take(body.number); }

  /// Returns the body of an agent that was prepared; null where it was left out.
  const PlacedBody* body(std::uint32_t agent) const noexcept {
    const std::size_t i = place_[agent - begin_];
    return i < bodies_.size() && place_[agent - begin_ + 1] > i ? &bodies_[i] : nullptr;
  }

  /// Calls found(obstacle) for each obstacle that an agent collides with, until it returns false.
  template <class Found>
  void visit_hits(std::uint32_t agent, const Found& found) {
    const PlacedBody* const body = this->body(agent);
    if (body == nullptr) return;
    near_body(*body);
    const bool stop = near_.any_obstacle([&](std::span<const LocalSegment> segments, std::uint32_t obstacle) {
      const bool hit = touches(*body, segments) || area_contains(*body, segments, obstacle) ||
                       outline_contains(*body, segments);
      return hit && !found(obstacle);
    });
    if (!stop) visit_areas_beyond(*body, found);
  }

  /// Finds the least gap, if at most `limit`, of an agent, metres. The search ends at a gap of at most `stop_below`.
  /// With `inside`, it also ends if an area contains the agent, or if the agent's outline contains a polyline.
  NearestObstacle nearest(std::uint32_t agent, double limit, double stop_below, bool inside);
  bool is_within(std::uint32_t agent, double distance) {
    return nearest(agent, distance, distance, true).is_within;
  }

  /// Returns whether one of two things holds: the body's outline contains a polyline, or an area contains a part of the
  /// body that touches none of the area's segments. That part is a disc or, with exact leaves, a part of the outline.
  /// Precondition: near_body() or another search of NearSegments found all segments in the root's disc.
  bool is_inside(const PlacedBody& body);
  /// Returns whether an obstacle is an area that contains a part of a body which touches none of the area's segments.
  /// `segments` are those of the area that are near the body.
  bool area_contains(const PlacedBody& body, std::span<const LocalSegment> segments, std::uint32_t obstacle);
  /// Calls found(obstacle) for the areas that contain a body and have no segment near it, until found() returns false.
  /// Returns: whether found() returned false.
  template <class Found>
  bool visit_areas_beyond(const PlacedBody& body, const Found& found) {
    if (is_too_large_for_areas(body.root())) return false;
    for (const std::uint32_t area : near_.areas_containing(body.place, body.centre()))
      if (!has_segment_of(area) && !found(area)) return true;
    return false;
  }

 protected:
  /// Calls visit(segments) for growing distances beyond that of prepare(). visit() updates `nearest`. The search ends
  /// when no segment beyond the distance can be nearer than `nearest`, or when the gap of `nearest` is at most
  /// `stop_below`. The segment nearest to the body's centre comes first. Its gap exceeds the least gap of all segments
  /// by at most twice the outer radius, so few other segments can be nearer.
  template <class Nearest, class Visit>
  void search_outward(const PlacedBody& body, double stop_below, const Nearest& nearest, const Visit& visit) {
    constexpr double least_step = 0.05;  // metres
    const double outer = body.outer_radius();
    for (double seen = body.searched;
         seen < nearest.gap && !(nearest.is_found && nearest.gap <= stop_below);) {
      double next = nearest.gap;
      if (!nearest.is_found && 2 * seen < next) {
        const double bound = near_.nearest_distance(body.place, body.centre()) - outer;
        if (bound == std::numeric_limits<double>::infinity()) return;
        // What is nearest as seen from above may be far above or below.
        const double step = in_space_ ? std::max({bound, 2 * seen, least_step}) : bound;
        if (step > seen) next = std::min(next, step);
      }
      visit(near_.find(body.place, body.centre(), outer + next));
      seen = next;
    }
  }

 private:
  Heights heights(std::uint32_t shape, double limit) const noexcept;
  void choose(std::uint32_t begin, std::uint32_t end, double limit, SearchMode mode);
  std::uint32_t level_of(std::uint32_t agent) const noexcept {
    return agents_.level.empty() ? shapes_.level_count - 1 : agents_.level[agent];
  }

  ObstacleArguments arguments(const PlacedBody& body, std::span<const LocalSegment> segments) const noexcept {
    return {&shapes_, body.root_index(), segments.data(), static_cast<std::uint32_t>(segments.size()),
            exact_leaves_};
  }
  bool touches(const PlacedBody& body, std::span<const LocalSegment> segments) const noexcept;
  /// Returns whether the outline of a body contains the first point of a polyline that it does not touch.
  bool outline_contains(const PlacedBody& body, std::span<const LocalSegment> segments) const noexcept;

  bool is_too_large_for_areas(const Root& root) const noexcept {
    return 2 * double{root.radius} > obstacles().widest_area;
  }
  bool has_segment_of(std::uint32_t obstacle) noexcept;

  const Implementation& implementation_;
  const ShapeSetView& shapes_;
  const Agents& agents_;
  NearSegments near_;
  const bool exact_leaves_, in_space_;
  /// Holds an agent that was not left out, and the distance within which segments are searched.
  struct Chosen {
    std::uint32_t agent;
    double searched;
  };
  std::vector<Chosen> chosen_;
  std::size_t chosen_count_ = 0;
  std::vector<NearQuery> queries_;  ///< by body
  std::vector<PlacedBody> bodies_;
  /// By agent from begin_ on: the index in bodies_ of its body, or of the next body if it was left out. There is one
  /// element more than agents: the last is the number of bodies.
  std::vector<std::size_t> place_;
  std::uint32_t begin_ = 0;  ///< the first agent that was prepared
};

}  // namespace bch::detail
