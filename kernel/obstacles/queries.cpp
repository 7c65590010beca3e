// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>
#include <limits>

#include <bch/obstacles.hpp>

#include "kernel/distance/distance_input.hpp"
#include "kernel/obstacles/query_input.hpp"
#include "kernel/runtime/kernels.hpp"
#include "layout/base/rounding.hpp"
#include "layout/format/cut_discs.hpp"

namespace bch {

using namespace detail;

namespace detail {

BodyQuery::Meaning meaning_of(const ShapeSet& shapes, const QueryOptions& options) {
  return {exact_leaves(shapes, options.leaves, "collide"), is_solid(shapes, options.semantics, "collide")};
}

}  // namespace detail

namespace {

using Vector = ObstaclePlace::Vector;

/// The nearest obstacle of an agent's parts so far.
struct NearestObstacle {
  double gap;                          ///< metres; of nothing found, the limit
  std::uint32_t disc = 0, number = 0;  ///< of the whole body; of the segment
  LocalSegment segment = {};
  Disc body_disc = {};
  ObstaclePlace place = {};
  bool is_found = false, is_near_enough = false;
};

/// Distances of all agents: what clearance() and within() share.
class GapQuery {
 public:
  /// The margin to prepare agents with.
  static double margin(double limit) noexcept { return std::min(limit, first_step); }

  GapQuery(const Implementation& implementation, const ShapeSetView& shapes) noexcept
      : implementation_(implementation), shapes_(shapes) {}

  /// What counts as near enough beside gaps.
  struct Inside {
    bool areas;     ///< an area that holds the agent
    bool outlines;  ///< a path that the agent's outline holds
  };

  /// Finds the least gap of at most `limit`, metres. The search ends where one is at most `enough`, or what counts is inside.
  NearestObstacle find(BodyQuery& body, std::uint32_t agent, double limit, double enough,
                       Inside inside) const {
    NearestObstacle nearest{.gap = std::min(limit, farthest)};
    body.visit_parts(agent, [&](const PlacedPart& part) {
      if (nearest.is_near_enough) return;
      find_in(body, part, enough, nearest);
      nearest.is_near_enough = (nearest.is_found && nearest.gap <= enough) ||
                               (inside.areas && body.area_that_holds(part) != no_obstacle) ||
                               (inside.outlines && body.outline_holds(part, body.near().found()));
    });
    return nearest;
  }

 private:
  static constexpr double first_step = 0.5;  ///< metres
  /// No gap is larger.
  static constexpr double farthest = 8 * rounding::largest_position;

  /// Where the limit is large the search goes outward, until no segment that was not looked at can be nearer than what was found.
  void find_in(BodyQuery& body, const PlacedPart& part, double enough, NearestObstacle& nearest) const {
    const double outer = part.outer_radius();
    // Discs of parts before come first where gaps are equal.
    std::uint32_t disc = nearest.is_found ? 0 : no_disc, number = disc;
    std::span<const LocalSegment> segments = body.near_part(part);
    for (double seen = margin(nearest.gap);;) {
      search(part, segments, enough, disc, number, nearest);
      if (nearest.gap <= seen || (nearest.is_found && nearest.gap <= enough)) return;
      seen = nearest.is_found ? nearest.gap : std::min(2 * seen, nearest.gap);
      segments = body.near().find(part.place, part.centre(), outer + seen);
    }
  }

  /// Searches segments for what is nearer, or comes before `disc` of the part and segment `number` where it is as near.
  void search(const PlacedPart& part, std::span<const LocalSegment> segments, double enough,
              std::uint32_t& disc, std::uint32_t& number, NearestObstacle& nearest) const {
    const LocalSegment* const before = nearest.is_found ? &nearest.segment : nullptr;
    ObstacleGap best{nearest.gap, disc, number, before};
    implementation_.kernels->find_gap(
        {&shapes_, part.root_index(), segments.data(), static_cast<std::uint32_t>(segments.size()), false},
        enough, best);
    if (best.segment == before) return;
    disc = best.disc, number = best.number;
    const CutDiscs discs = cut_discs(shapes_, part.root_index());
    nearest = {.gap = best.gap,
               .disc = first_disc(shapes_, part.shape, part.part, part.level) + disc,
               .number = number,
               .segment = *best.segment,
               .body_disc = {discs.x[disc], discs.y[disc], discs.radius[disc]},
               .place = part.place,
               .is_found = true};
  }

  const Implementation& implementation_;
  const ShapeSetView& shapes_;
};

/// Returns the vector from a disc's centre to the nearest point of a segment, in the agent's frame.
Vector to_nearest_point(const LocalSegment& segment, const Disc& disc) noexcept {
  const double x = disc.x, y = disc.y;
  const double along = segment.along(x, y), aside = -segment.across(x, y);
  const double forward = std::clamp(along, segment.from, segment.to) - along;
  return {forward * segment.x - aside * segment.y, forward * segment.y + aside * segment.x};
}

Vec2 to_float(Vector v) noexcept {
  return {static_cast<float>(v.x), static_cast<float>(v.y)};
}

/// Writes the answers for what was found.
void put(const ClearanceAnswers& answers, std::size_t i, const NearestObstacle& nearest) {
  answers.distance[i] = rounding::round_down(nearest.gap);
  const Disc& disc = nearest.body_disc;
  const Vector way = to_nearest_point(nearest.segment, disc);
  const double length = std::sqrt(way.x * way.x + way.y * way.y);
  const Vector turned = nearest.place.turned(way.x, way.y),
               centre = nearest.place.turned(double{disc.x}, double{disc.y});
  const Vector unit = length > 0 ? Vector{turned.x / length, turned.y / length} : Vector{1, 0};
  if (!answers.direction.empty()) answers.direction[i] = to_float(unit);
  if (!answers.discs.empty()) answers.discs[i] = {nearest.disc, nearest.number};
  if (!answers.points.empty()) {
    const double r = disc.radius;
    answers.points[i] = {to_float({centre.x + r * unit.x, centre.y + r * unit.y}),
                         to_float({centre.x + turned.x, centre.y + turned.y})};
  }
}

}  // namespace

void collide(const ShapeSet& shapes, const Agents& agents, const ObstacleSet& obstacles,
             std::span<std::uint8_t> hits, const QueryOptions& options) {
  const FloatingPointStateGuard floats;
  require_as_many({"collide", "agent", agents.size()}, hits.size(), "hits");
  const BodyQuery::Meaning meaning = meaning_of(shapes, options);
  const Implementation& implementation = chosen(options, "collide");
  validate(shapes, agents);
  for_agents(implementation, shapes, agents, obstacles, 0, [&](BodyQuery& body, std::uint32_t agent) {
    bool hit = false;
    body.visit_parts(agent, [&](const PlacedPart& part) {
      if (!hit) body.visit_hits(part, meaning, [&](std::uint32_t) { return hit = true, false; });
    });
    hits[agent] = hit;
  });
}

void within(const ShapeSet& shapes, const Agents& agents, const ObstacleSet& obstacles,
            std::span<const double> distances, std::span<std::uint8_t> answers, const QueryOptions& options) {
  const FloatingPointStateGuard floats;
  const Asked asked{"within", "agent", agents.size()};
  require_as_many(asked, answers.size(), "answers");
  require_distances(asked, distances);
  const bool solid = is_solid(shapes, options.semantics, "within");
  const Implementation& implementation = chosen(options, "within");
  validate(shapes, agents);
  const GapQuery query(implementation, shapes.view());
  const double most = distances.empty() ? 0 : *std::max_element(distances.begin(), distances.end());
  for_agents(implementation, shapes, agents, obstacles, GapQuery::margin(most),
             [&](BodyQuery& body, std::uint32_t agent) {
               const double distance = distances[distances.size() == 1 ? 0 : agent];
               const NearestObstacle nearest = query.find(body, agent, distance, distance, {true, solid});
               answers[agent] = nearest.is_near_enough;
             });
}

void clearance(const ShapeSet& shapes, const Agents& agents, const ObstacleSet& obstacles,
               const ClearanceAnswers& answers, const QueryOptions& options) {
  const FloatingPointStateGuard floats;
  require_valid({"clearance", "agent", agents.size()}, answers, options);
  const Implementation& implementation = chosen(options, "clearance");
  validate(shapes, agents);
  const bool zero = options.overlap == Overlap::zero;
  const double enough = zero ? 0 : -std::numeric_limits<double>::infinity();
  const GapQuery query(implementation, shapes.view());
  for_agents(
      implementation, shapes, agents, obstacles, GapQuery::margin(options.max_distance),
      [&](BodyQuery& body, std::uint32_t agent) {
        const NearestObstacle nearest = query.find(body, agent, options.max_distance, enough, {zero, false});
        if (nearest.is_near_enough) return put_alone(answers, agent, 0);
        if (!nearest.is_found) return put_alone(answers, agent, std::numeric_limits<float>::infinity());
        put(answers, agent, nearest);
      });
}

}  // namespace bch
