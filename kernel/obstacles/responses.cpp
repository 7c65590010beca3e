// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <bch/obstacles.hpp>

#include "kernel/distance/distance_input.hpp"
#include "kernel/obstacles/part_tree.hpp"
#include "kernel/obstacles/query_input.hpp"
#include "kernel/simd/tree_nodes.hpp"
#include "layout/base/rounding.hpp"
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

/// The stretch of a segment's line on which discs count.
struct Range {
  double from, to;  ///< along it
};
constexpr Range everywhere{-infinity, infinity};

/// Returns how far discs beside the range have to move towards a side of a segment, 1 the left one, until none is across.
double depth_towards(int side, const LocalSegment& segment, Range range, const CutDiscs& discs) noexcept {
  double depth = 0;
  for (std::uint32_t i = 0; i < discs.count; ++i) {
    const double x = discs.x[i], y = discs.y[i], r = double{discs.radius[i]} + segment.slack;
    const double along = segment.along(x, y);
    if (along >= range.from - r && along <= range.to + r)
      depth = std::max(depth, r - side * segment.across(x, y));
  }
  return depth;
}

/// The ways out of the obstacles that a part touches.
class WaysOut {
 public:
  WaysOut(BodyQuery& body, const PlacedPart& part)
      : body_(body), part_(part), discs_(cut_discs(part.shapes, part.root_index())) {}

  /// Returns the farthest of the ways out of each obstacle.
  WayOut farthest() {
    WayOut farthest;
    bool is_any_touched = false;
    body_.near_part(part_);
    body_.near().any_obstacle([&](std::span<const LocalSegment> segments, std::uint32_t) {
      touched_.clear();
      for (const LocalSegment& segment : segments)
        if (is_touched(segment)) touched_.push_back(&segment);
      if (touched_.empty()) return false;
      is_any_touched = true;
      const WayOut way = is_post() ? from_post(*touched_.front()) : shortest(segments);
      if (way.depth > farthest.depth) farthest = way;
      return false;
    });
    if (is_any_touched) return farthest;
    const std::uint32_t area = body_.area_that_holds(part_, false);
    const LocalSegment* const nearest = area == no_obstacle ? nullptr : nearest_of(area);
    return nearest == nullptr ? farthest : over(*nearest, everywhere);
  }

 private:
  bool is_touched(const LocalSegment& segment) const noexcept {
    for (std::uint32_t i = 0; i < discs_.count; ++i)
      if (segment.touches(double{discs_.x[i]}, double{discs_.y[i]}, double{discs_.radius[i]})) return true;
    return false;
  }

  static bool has_length(const LocalSegment& segment) noexcept { return segment.from < segment.to; }

  /// Returns whether no segment that is touched has a direction.
  bool is_post() const noexcept {
    return std::none_of(touched_.begin(), touched_.end(),
                        [](const LocalSegment* segment) { return has_length(*segment); });
  }

  /// Returns the way away from a point: that of the disc that overlaps it the deepest.
  WayOut from_post(const LocalSegment& post) const {
    // The point in the agent's frame, and the disc.
    const double px = post.from * post.x - post.offset * post.y,
                 py = post.from * post.y + post.offset * post.x;
    double deepest = infinity, ux = 1, uy = 0;
    for (std::uint32_t i = 0; i < discs_.count; ++i) {
      const double dx = double{discs_.x[i]} - px, dy = double{discs_.y[i]} - py;
      const double length = std::sqrt(dx * dx + dy * dy), gap = length - double{discs_.radius[i]};
      if (gap >= deepest) continue;
      deepest = gap;
      ux = length > 0 ? dx / length : 1, uy = length > 0 ? dy / length : 0;
    }
    // A line through the point, which has the disc on its left.
    LocalSegment across = post;
    across.x = uy, across.y = -ux;
    across.from = across.to = px * across.x + py * across.y;
    across.offset = px * ux + py * uy;
    const double depth = depth_towards(1, across, {across.from, across.to}, discs_);
    return {with_margin(depth, across), part_.place.turned(ux, uy)};
  }

  double with_margin(double depth, const LocalSegment& segment) const noexcept {
    // For the rounding of the depth to float, and of the new position.
    const double margin = 0x1p-20 * part_.outer_radius() + 2 * segment.slack;
    return (depth + margin) * (1 + 0x1p-22);
  }

  /// Returns the shortest way out of an obstacle: over a segment that is touched, or one that has all of those behind it.
  WayOut shortest(std::span<const LocalSegment> segments) const {
    WayOut shortest{infinity, {}};
    for (const LocalSegment& segment : segments) {
      if (!has_length(segment)) continue;
      const Touched touched = touched_from(segment);
      const int side = body_.near().obstacles().outside[segment.number];
      const bool is_behind = side != 0 && (side > 0 ? touched.left : -touched.right) <= segment.slack;
      if (!is_behind && !is_touched(segment)) continue;
      const WayOut way = over(segment, side == 0 ? touched.range : everywhere);
      if (way.depth < shortest.depth) shortest = way;
    }
    return shortest;
  }

  const WorldSegment& in_world(const LocalSegment& segment) const noexcept {
    return body_.near().obstacles().segments[segment.slot];
  }

  /// Where the touched segments of an obstacle are, along a line and across it: how far to the left and to the right.
  struct Touched {
    Range range{infinity, -infinity};
    double left = -infinity, right = infinity;
  };
  Touched touched_from(const LocalSegment& segment) const noexcept {
    Touched touched;
    const WorldSegment& line = in_world(segment);
    for (const LocalSegment* const other : touched_) {
      const WorldSegment& world = in_world(*other);
      for (const auto& [x, y] : {Vector{world.ax, world.ay}, Vector{world.bx, world.by}}) {
        const double dx = x - line.ax, dy = y - line.ay;
        const double along = segment.from + dx * line.x + dy * line.y, across = line.x * dy - line.y * dx;
        touched.range = {std::min(touched.range.from, along), std::max(touched.range.to, along)};
        touched.left = std::max(touched.left, across), touched.right = std::min(touched.right, across);
      }
    }
    return touched;
  }

  WayOut over(const LocalSegment& segment, Range range) const {
    int side = body_.near().obstacles().outside[segment.number];
    double depth = depth_towards(side == 0 ? 1 : side, segment, range, discs_);
    if (side == 0) {
      const double right = depth_towards(-1, segment, range, discs_);
      side = right < depth ? -1 : 1;
      depth = std::min(depth, right);
    }
    const WorldSegment& world = in_world(segment);
    return {with_margin(depth, segment), {-side * world.y, side * world.x}};
  }

  /// Returns the segment of an area that is the nearest to the part's centre. There is none where a set has numbers that are no lengths.
  const LocalSegment* nearest_of(std::uint32_t area) {
    const Vec2 centre = part_.centre();
    const double distance = body_.near().nearest_distance(part_.place, centre, area);
    const LocalSegment* nearest = nullptr;
    double least = infinity;
    for (const LocalSegment& segment : body_.near().find(part_.place, centre, distance)) {
      const double square = segment.square_distance(double{centre.x}, double{centre.y});
      if (segment.obstacle == area && in_world(segment).length > 0 && square < least)
        least = square, nearest = &segment;
    }
    return nearest;
  }

  BodyQuery& body_;
  const PlacedPart& part_;
  const CutDiscs discs_;
  std::vector<const LocalSegment*> touched_;
};

/// Returns when a disc on its way touches a segment: the least t in [0, 1], or infinity. Every quotient is of lengths
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

/// Returns when a part on its way touches an obstacle, or infinity.
double impact(BodyQuery& body, const PlacedPart& part, Vector way_in_world) {
  const Vec2 centre = part.centre();
  body.near_part(part);
  if (body.area_that_holds(part, false) != no_obstacle) return 0;
  const bool is_solid = part.shapes.slab_parts != nullptr;
  if (is_solid && body.outline_holds(part, body.near().found())) return 0;
  const Vector way = part.place.turned_back(way_in_world.x, way_in_world.y);
  double best = infinity;
  for (const LocalSegment& segment :
       body.near().find_on_way(part.place, centre, part.outer_radius(), way_in_world))
    find_time(part, segment, way, best);
  return best;
}

}  // namespace

void penetration(const ShapeSet& shapes, const Agents& agents, const ObstacleSet& obstacles,
                 std::span<Penetration> out, const QueryOptions& options) {
  const FloatingPointStateGuard floats;
  require_as_many({"penetration", "agent", agents.size()}, out.size(), "answers");
  const Implementation& implementation = chosen(options, "penetration");
  validate(shapes, agents);
  for_agents(implementation, shapes, agents, obstacles, 0, Look::touching,
             [&](BodyQuery& body, std::uint32_t agent) {
               WayOut farthest;
               body.visit_parts(agent, [&](const PlacedPart& part) {
                 const WayOut way = WaysOut(body, part).farthest();
                 if (way.depth > farthest.depth) farthest = way;
               });
               const auto [depth, direction] = farthest;
               out[agent] = {depth > 0 ? rounding::round_up(depth) : 0.0f, direction.x, direction.y};
             });
}

void time_of_impact(const ShapeSet& shapes, const Agents& agents, const Displacements& displacements,
                    const ObstacleSet& obstacles, std::span<float> times, const QueryOptions& options) {
  const FloatingPointStateGuard floats;
  require_valid({"time_of_impact", "agent", agents.size()}, displacements, times.size());
  const Implementation& implementation = chosen(options, "time_of_impact");
  validate(shapes, agents);
  double farthest = 0;
  for (std::size_t i = 0; i < agents.size(); ++i)
    farthest = std::max(farthest, std::abs(displacements.x[i]) + std::abs(displacements.y[i]));
  for_agents(implementation, shapes, agents, obstacles, farthest, Look::touching,
             [&](BodyQuery& body, std::uint32_t agent) {
               double best = infinity;
               body.visit_parts(agent, [&](const PlacedPart& part) {
                 best = std::min(best, impact(body, part, {displacements.x[agent], displacements.y[agent]}));
               });
               times[agent] = rounding::round_down(best);
             });
}

}  // namespace bch
