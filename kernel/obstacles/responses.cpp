// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <bch/obstacles.hpp>

#include "kernel/obstacles/part_tree.hpp"
#include "kernel/obstacles/query_input.hpp"
#include "kernel/simd/tree_nodes.hpp"
#include "layout/base/rounding.hpp"
#include "layout/base/shortest.hpp"
#include "layout/format/cut_discs.hpp"

namespace bch {

using namespace detail;

namespace {

using Vector = ObstaclePlace::Vector;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A way out over a segment.
struct WayOut {
  double depth = 0;
  Vector direction = {0, 0};  ///< in the world
};

/// Returns how far a part has to move towards a side of a segment, 1 the left one, until none of its discs is across: of those
/// beside the segment, or of all.
double depth_towards(int side, const LocalSegment& segment, const CutDiscs& discs, bool all) noexcept {
  double depth = 0;
  for (std::uint32_t i = 0; i < discs.count; ++i) {
    const double x = discs.x[i], y = discs.y[i], r = double{discs.radius[i]} + segment.slack;
    const double along = segment.along(x, y);
    if (all || (along >= segment.from - r && along <= segment.to + r))
      depth = std::max(depth, r - side * segment.across(x, y));
  }
  return depth;
}

WayOut way_over(const BodyQuery& body, const PlacedPart& part, const LocalSegment& segment, bool all) {
  const CutDiscs discs = cut_discs(part.shapes, part.root_index());
  int side = body.near().obstacles().outside[segment.number];
  double depth = depth_towards(side == 0 ? 1 : side, segment, discs, all);
  if (side == 0) {
    const double right = depth_towards(-1, segment, discs, all);
    side = right < depth ? -1 : 1;
    depth = std::min(depth, right);
  }
  // Positions are right to some 2^-53 of themselves, and the directions that callers round to float to u.
  const double margin = 0x1p-20 * part.outer_radius() + 2 * segment.slack;
  return {(depth + margin) * (1 + 0x1p-22), part.place.turned(-side * segment.y, side * segment.x)};
}

bool is_touched(const LocalSegment& segment, const CutDiscs& discs) noexcept {
  for (std::uint32_t i = 0; i < discs.count; ++i)
    if (segment.touches(double{discs.x[i]}, double{discs.y[i]}, double{discs.radius[i]})) return true;
  return false;
}

/// Returns the way out of the segments that a part touches, the farthest; or out of an area that holds it.
WayOut way_out(BodyQuery& body, const PlacedPart& part) {
  WayOut farthest;
  const CutDiscs discs = cut_discs(part.shapes, part.root_index());
  bool is_any_touched = false;
  for (const LocalSegment& segment : body.near().find(part.place, part.centre(), part.outer_radius())) {
    if (!is_touched(segment, discs)) continue;
    is_any_touched = true;
    const WayOut way = way_over(body, part, segment, false);
    if (way.depth > farthest.depth) farthest = way;
  }
  if (is_any_touched) return farthest;
  const std::uint32_t area = body.area_that_holds(part);
  if (area == no_obstacle) return farthest;
  const LocalSegment* nearest = nullptr;
  double least = infinity;
  const Vec2 centre = part.centre();
  for (double distance = part.outer_radius(); nearest == nullptr; distance *= 4)
    for (const LocalSegment& segment : body.near().find(part.place, centre, distance)) {
      const double square = segment.square_distance(double{centre.x}, double{centre.y});
      if (segment.obstacle == area && square < least) least = square, nearest = &segment;
    }
  return way_over(body, part, *nearest, true);
}

/// A disc on its way beside a segment: the least t in [0, 1] at which it touches that, or infinity. Every quotient is of lengths
/// that were not subtracted from each other where they are large.
double touch_time(const LocalSegment& segment, const Disc& disc, Vector way) noexcept {
  const double x = disc.x, y = disc.y, r = double{disc.radius} + segment.slack;
  if (segment.touches(x, y, double{disc.radius})) return 0;
  const double along = segment.along(x, y), across = segment.across(x, y);
  const double forward = segment.x * way.x + segment.y * way.y, aside = segment.x * way.y - segment.y * way.x;
  double time = infinity;
  const double towards = across > 0 ? -aside : aside, left = std::abs(across) - r;
  if (towards > 0 && left >= 0) {
    const double t = left / towards, at = along + t * forward;
    if (at >= segment.from && at <= segment.to) time = t;
  }
  const double square = forward * forward + aside * aside;
  for (const double end : {segment.from, segment.to}) {
    const double dx = end - along, dy = -across;
    const double near = dx * forward + dy * aside, cross = dx * aside - dy * forward;
    const double under_root = r * r * square - cross * cross;
    const double outside = dx * dx + dy * dy - r * r;
    if (near > 0 && under_root >= 0 && outside >= 0)
      time = std::min(time, outside / (near + std::sqrt(under_root)));
  }
  return time <= 1 ? time : infinity;
}

/// Returns whether nothing in a disc can touch a segment before a time.
bool passes(const LocalSegment& segment, const Disc& disc, Vector way, double time) noexcept {
  const double x = disc.x, y = disc.y, r = (double{disc.radius} + segment.slack) * (1 + 0x1p-20);
  const double along = segment.along(x, y), across = segment.across(x, y);
  const double forward = time * (segment.x * way.x + segment.y * way.y),
               aside = time * (segment.x * way.y - segment.y * way.x);
  return along + std::max(forward, 0.0) + r < segment.from ||
         along + std::min(forward, 0.0) - r > segment.to || across + std::min(aside, 0.0) > r ||
         across + std::max(aside, 0.0) < -r;
}

/// Finds when a part touches a segment, if that is before `best`.
void find_time(const PlacedPart& part, const LocalSegment& segment, Vector way, double& best) {
  const PartTree<void> own(part.shapes, part.root_index());
  std::uint32_t open[7 * most_wide_levels + 1], count = 0;
  open[count++] = own.tree.top;
  while (count != 0 && best > 0) {
    const std::uint32_t node = open[--count];
    const Discs discs = TreeNodes<void>::outer_discs(own.nodes, node, own.tree.stride);
    for (unsigned lane = 0; lane < block_width; ++lane) {
      const Disc disc{discs.x[lane], discs.y()[lane], discs.radius()[lane]};
      if (!(disc.x < __builtin_inff()) || passes(segment, disc, way, std::min(best, 1.0))) continue;
      if (node < leaf_window)
        open[count++] = TreeNodes<void>::child(own.nodes, node, lane);
      else
        best = std::min(best, touch_time(segment, disc, way));
    }
  }
}

double impact(BodyQuery& body, const PlacedPart& part, Vector way_in_world) {
  const Vec2 centre = part.centre();
  body.near().find(part.place, centre, part.outer_radius());
  if (body.area_that_holds(part) != no_obstacle) return 0;
  const Vector way = part.place.turned_back(way_in_world.x, way_in_world.y);
  double best = infinity;
  for (const LocalSegment& segment : body.near().find(part.place, centre, part.outer_radius(), way_in_world))
    find_time(part, segment, way, best);
  return best;
}

/// Returns the largest float that is not above a time.
float rounded_down(double time) noexcept {
  const float nearest = static_cast<float>(time);
  return double{nearest} > time ? std::nextafter(nearest, -1.0f) : nearest;
}

void require_valid(const Displacements& displacements, const Agents& agents) {
  require_an_answer_each("time_of_impact", agents, displacements.x.size(), "displacements in x");
  require_an_answer_each("time_of_impact", agents, displacements.y.size(), "displacements in y");
  const auto good = [](double length) { return std::abs(length) <= rounding::largest_position; };
  for (std::size_t i = 0; i < displacements.x.size(); ++i)
    if (!good(displacements.x[i]) || !good(displacements.y[i]))
      throw std::invalid_argument("time_of_impact: agent " + std::to_string(i) + ": displacement (" +
                                  shortest(displacements.x[i]) + ", " + shortest(displacements.y[i]) +
                                  ") m is not within +-1e9");
}

}  // namespace

void penetration(const ShapeSet& shapes, const Agents& agents, const ObstacleSet& obstacles,
                 std::span<Penetration> out, const QueryOptions& options) {
  const FloatingPointStateGuard floats;
  require_an_answer_each("penetration", agents, out.size(), "answers");
  const Implementation& implementation = chosen(options, "penetration");
  validate(shapes, agents);
  for_agents(implementation, shapes, agents, obstacles, [&](BodyQuery& body, std::uint32_t agent) {
    WayOut farthest;
    body.visit_parts(agent, [&](const PlacedPart& part) {
      const WayOut way = way_out(body, part);
      if (way.depth > farthest.depth) farthest = way;
    });
    const auto [depth, direction] = farthest;
    out[agent] = {depth > 0 ? rounding::round_up(depth) : 0.0f, direction.x, direction.y};
  });
}

void time_of_impact(const ShapeSet& shapes, const Agents& agents, const Displacements& displacements,
                    const ObstacleSet& obstacles, std::span<float> times, const QueryOptions& options) {
  const FloatingPointStateGuard floats;
  require_an_answer_each("time_of_impact", agents, times.size(), "times");
  require_valid(displacements, agents);
  const Implementation& implementation = chosen(options, "time_of_impact");
  validate(shapes, agents);
  for_agents(implementation, shapes, agents, obstacles, [&](BodyQuery& body, std::uint32_t agent) {
    double best = infinity;
    body.visit_parts(agent, [&](const PlacedPart& part) {
      best = std::min(best, impact(body, part, {displacements.x[agent], displacements.y[agent]}));
    });
    times[agent] = rounded_down(best);
  });
}

}  // namespace bch
