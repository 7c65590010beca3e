// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/obstacles/gap_query.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/distance/nearest_features.hpp"
#include "kernel/runtime/kernels.hpp"
#include "layout/format/cut_discs.hpp"

namespace bch::detail {
namespace {

using Vector = ObstaclePlace::Vector;

double square(Vector v) noexcept {
  return v.x * v.x + v.y * v.y;
}

/// What is nearest to an obstacle's segment, a disc's centre or a point of an outline, and the way from there, in the agent's frame.
struct Nearest {
  Vector from, way;
  double radius;  ///< of the disc
};

Nearest of_disc(const CutDiscs& discs, std::uint32_t disc, const LocalSegment& segment) noexcept {
  const double x = discs.x[disc], y = discs.y[disc];
  return {{x, y}, to_nearest_point(segment, x, y), discs.radius[disc]};
}

/// Returns the nearest points of an outline's segment and an obstacle's that do not cross: an end of one, and what is nearest to it.
Nearest of_outline(const Vec2* ends, const LocalSegment& segment) noexcept {
  const double x = ends[0].x, y = ends[0].y, way_x = double{ends[1].x} - x, way_y = double{ends[1].y} - y;
  const double length = square({way_x, way_y});
  Nearest nearest{{x, y}, to_nearest_point(segment, x, y), 0};
  const auto take = [&](double share) {
    const Vector at{x + share * way_x, y + share * way_y}, to = to_nearest_point(segment, at.x, at.y);
    if (square(to) < square(nearest.way)) nearest = {at, to, 0};
  };
  take(1);
  for (const double end : {segment.from, segment.to}) {
    const double to_x = end * segment.x - segment.offset * segment.y - x,
                 to_y = end * segment.y + segment.offset * segment.x - y;
    if (length > 0) take(std::clamp((to_x * way_x + to_y * way_y) / length, 0.0, 1.0));
  }
  return nearest;
}

Vec2 to_float(Vector v) noexcept {
  return {static_cast<float>(v.x), static_cast<float>(v.y)};
}

}  // namespace

void store(const ShapeSetView& shapes, const ClearanceAnswers& answers, std::size_t i,
           const NearestObstacle& nearest) {
  answers.distance[i] = rounding::round_down(nearest.gap);
  if (answers.direction.empty() && answers.discs.empty() && answers.points.empty()) return;
  const bool is_disc = nearest.point == no_point;
  const auto [at, way, radius] = is_disc
                                     ? of_disc(cut_discs(shapes, nearest.root), nearest.disc, nearest.segment)
                                     : of_outline(shapes.points + nearest.point, nearest.segment);
  const double length = std::sqrt(square(way));
  const Vector turned = nearest.place.turned(way.x, way.y), from = nearest.place.turned(at.x, at.y);
  const Vector unit = length > 0 ? Vector{turned.x / length, turned.y / length} : Vector{1, 0};
  if (!answers.direction.empty()) answers.direction[i] = to_float(unit);
  if (!answers.discs.empty()) {
    const std::uint32_t disc =
        is_disc ? nearest.disc : leaf_that_holds(shapes, nearest.root, nearest.point, at.x, at.y);
    answers.discs[i] = {disc, nearest.segment.number};
  }
  if (!answers.points.empty())
    answers.points[i] = {to_float({from.x + radius * unit.x, from.y + radius * unit.y}),
                         to_float({from.x + turned.x, from.y + turned.y})};
}

NearestObstacle GapQuery::find(BodyQuery& query, std::uint32_t agent, double limit, double enough,
                               bool inside) const {
  NearestObstacle nearest{.gap = std::min(limit, farthest_gap)};
  const PlacedBody* const placed = query.body(agent);
  if (placed == nullptr) return nearest;
  const PlacedBody& body = *placed;
  ObstacleGap best{nearest.gap, no_disc, no_disc, no_disc, nullptr};
  const std::span<const LocalSegment> segments = query.near_body(body);
  search(body, segments, enough, best, nearest);
  nearest.is_near_enough = (nearest.is_found && nearest.gap <= enough) ||
                           (inside && (query.area_that_holds(body, exact_leaves_) != no_obstacle ||
                                       query.outline_holds(body, segments)));
  if (nearest.is_near_enough || nearest.gap <= body.looked) return nearest;
  search_outward(query, body, enough, best, nearest);
  nearest.is_near_enough = nearest.is_found && nearest.gap <= enough;
  return nearest;
}

/// Looks at the segment that is nearest to the body's centre first: its gap, which is at most twice the outer radius larger than the least
/// one can be, leaves few others to look at.
void GapQuery::search_outward(BodyQuery& query, const PlacedBody& body, double enough, ObstacleGap& best,
                              NearestObstacle& nearest) const {
  const double outer = body.outer_radius();
  double seen = body.looked;
  const auto look = [&](double distance) {
    seen = distance;
    search(body, query.near().find(body.place, body.centre(), outer + distance), enough, best, nearest);
  };
  if (!nearest.is_found && 2 * seen < nearest.gap) {
    const double bound = query.near().nearest_distance(body.place, body.centre()) - outer;
    if (bound == std::numeric_limits<double>::infinity()) return;
    if (bound > seen) look(std::min(bound, nearest.gap));
  }
  if (nearest.gap > seen && !(nearest.is_found && nearest.gap <= enough)) look(nearest.gap);
}

/// Searches segments for what comes before the best.
void GapQuery::search(const PlacedBody& body, std::span<const LocalSegment> segments, double enough,
                      ObstacleGap& best, NearestObstacle& nearest) const {
  best.segment = nullptr;
  implementation_.kernels->find_gap({&shapes_, body.root_index(), segments.data(),
                                     static_cast<std::uint32_t>(segments.size()), exact_leaves_},
                                    enough, best);
  if (best.segment == nullptr) return;
  nearest = {.gap = best.gap,
             .point = best.point,
             .disc = best.disc,
             .root = body.root_index(),
             .segment = *best.segment,
             .place = body.place,
             .is_found = true};
}

}  // namespace bch::detail
