// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/obstacles/exit_moves.hpp"

#include <algorithm>
#include <cmath>

namespace bch::detail {
namespace {

bool has_length(const LocalSegment& segment) noexcept {
  return segment.from < segment.to;
}

void keep_longer(ExitMove& longest, const ExitMove& move) noexcept {
  if (move.depth > longest.depth) longest = move;
}

}  // namespace

ExitMove ExitMoves::longest() {
  ExitMove longest;
  std::vector<std::uint32_t> areas;  // that hold the body clear of their segments
  query_.near_body(body_);
  query_.near().any_obstacle([&](std::span<const LocalSegment> segments, std::uint32_t obstacle) {
    find_touched(segments);
    if (!touched_.empty())
      keep_longer(longest, is_post() ? from_post(*touched_.front()) : shortest(segments));
    else if (query_.area_contains(body_, segments, obstacle))
      areas.push_back(obstacle);
    return false;
  });
  query_.visit_areas_beyond(body_, [&](std::uint32_t area) { return areas.push_back(area), true; });
  if (areas.empty()) return longest;
  std::sort(areas.begin(), areas.end());
  keep_longer(longest, longest_out_of(areas));
  return longest;
}

void ExitMoves::find_touched(std::span<const LocalSegment> segments) {
  touched_.clear();
  for (const LocalSegment& segment : segments)
    if (is_touched(segment)) touched_.push_back(&segment);
}

bool ExitMoves::is_touched(const LocalSegment& segment) const noexcept {
  for (std::uint32_t i = 0; i < discs_.count; ++i)
    if (segment.touches(double{discs_.x[i]}, double{discs_.y[i]}, double{discs_.radius[i]})) return true;
  return false;
}

bool ExitMoves::is_post() const noexcept {
  return std::none_of(touched_.begin(), touched_.end(),
                      [](const LocalSegment* segment) { return has_length(*segment); });
}

ExitMove ExitMoves::from_post(const LocalSegment& post) const {
  // The point in the agent's frame, and the disc.
  const double px = post.from * post.x - post.offset * post.y, py = post.from * post.y + post.offset * post.x;
  double deepest = std::numeric_limits<double>::infinity(), ux = 1, uy = 0;
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
  const double depth = depth_towards(1, across, {across.from, across.to});
  const auto [x, y] = body_.place.turned(ux, uy);
  return {with_margin(depth, across), {x, y}};
}

ExitMove ExitMoves::shortest(std::span<const LocalSegment> segments) {
  hull_.clear();
  for (const LocalSegment* const segment : touched_) {
    const WorldSegment& world = in_world(*segment);
    hull_.add({world.ax, world.ay}), hull_.add({world.bx, world.by});
  }
  hull_.close();
  ExitMove shortest{std::numeric_limits<double>::infinity(), {}};
  for (const LocalSegment& segment : segments) {
    if (!has_length(segment)) continue;
    const int side = query_.obstacles().outside[segment.number];
    if (!(side != 0 && has_all_behind(segment, side)) && !is_touched(segment)) continue;
    const ExitMove move = over(segment, side == 0 ? touched_range(segment) : Range{});
    if (move.depth < shortest.depth) shortest = move;
  }
  return shortest;
}

bool ExitMoves::has_all_behind(const LocalSegment& segment, int side) const {
  const WorldSegment& line = in_world(segment);
  return hull_.most([&](EndsHull::Point end) {
    const double dx = end.x - line.ax, dy = end.y - line.ay;
    return side * (line.x * dy - line.y * dx);
  }) <= segment.slack;
}

ExitMoves::Range ExitMoves::touched_range(const LocalSegment& segment) const {
  const WorldSegment& line = in_world(segment);
  const auto along = [&](EndsHull::Point end) {
    const double dx = end.x - line.ax, dy = end.y - line.ay;
    return segment.from + dx * line.x + dy * line.y;
  };
  return {-hull_.most([&](EndsHull::Point end) { return -along(end); }), hull_.most(along)};
}

/// An area has no nearest segment where a set has numbers that are no lengths. One search serves all areas, however many there are.
ExitMove ExitMoves::longest_out_of(std::span<const std::uint32_t> areas) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  struct Nearest {
    LocalSegment segment = {};
    double square = infinity;
  };
  std::vector<Nearest> nearest(areas.size());
  const Vec2 centre = body_.centre();
  std::size_t missing = areas.size();
  double limit = infinity;
  query_.near().visit_near(body_.place, centre, limit, [&](const LocalSegment& segment) {
    const auto area = std::lower_bound(areas.begin(), areas.end(), segment.obstacle);
    if (area == areas.end() || *area != segment.obstacle || !(in_world(segment).length > 0)) return;
    Nearest& of_area = nearest[static_cast<std::size_t>(area - areas.begin())];
    const double square = segment.square_distance(double{centre.x}, double{centre.y});
    const bool is_first = of_area.square == infinity;
    if (square < of_area.square || (square == of_area.square && segment.number < of_area.segment.number))
      of_area = {segment, square};
    missing -= is_first;
    // With many areas the limit is set once: it is sufficiently near then, and looking for the largest number takes time.
    if (missing != 0 || (!is_first && areas.size() > 1)) return;
    double most = 0;
    for (const Nearest& of : nearest) most = std::max(most, of.square);
    limit = NearSegments::limit_of(body_.place, std::sqrt(most));
  });
  ExitMove longest;
  for (const auto& [segment, square] : nearest)
    if (square < infinity) keep_longer(longest, over(segment, {}));
  return longest;
}

ExitMove ExitMoves::over(const LocalSegment& segment, Range range) const {
  int side = query_.obstacles().outside[segment.number];
  double depth = depth_towards(side == 0 ? 1 : side, segment, range);
  if (side == 0) {
    const double right = depth_towards(-1, segment, range);
    side = right < depth ? -1 : 1;
    depth = std::min(depth, right);
  }
  const WorldSegment& world = in_world(segment);
  return {with_margin(depth, segment), {-side * world.y, side * world.x}};
}

/// Returns how far discs within the range have to move towards a side of a segment, 1 the left one, until none is across.
double ExitMoves::depth_towards(int side, const LocalSegment& segment, Range range) const noexcept {
  double depth = 0;
  for (std::uint32_t i = 0; i < discs_.count; ++i) {
    const double x = discs_.x[i], y = discs_.y[i], r = double{discs_.radius[i]} + segment.slack;
    const double along = segment.along(x, y);
    if (along >= range.from - r && along <= range.to + r)
      depth = std::max(depth, r - side * segment.across(x, y));
  }
  return depth;
}

double ExitMoves::with_margin(double depth, const LocalSegment& segment) const noexcept {
  // For the rounding of the depth to float, and of the new position.
  const double margin = 0x1p-20 * body_.outer_radius() + 2 * segment.slack;
  return (depth + margin) * (1 + 0x1p-22);
}

}  // namespace bch::detail
