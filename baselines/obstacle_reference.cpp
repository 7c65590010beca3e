// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/obstacle_reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "layout/base/heading.hpp"

namespace bch::baselines {
namespace {

/// A segment in an agent's frame: along and across it, and the slack for what is far.
struct Line {
  double x, y, offset, from, to, slack;

  Line(const Agents& agents, std::uint32_t agent, const std::array<double, 4>& segment) {
    const auto [ax, ay, bx, by] = segment;
    const double way_x = bx - ax, way_y = by - ay, length = std::sqrt(way_x * way_x + way_y * way_y);
    const double u = length > 0 ? way_x / length : 1, v = length > 0 ? way_y / length : 0;
    const double dx = ax - agents.x[agent], dy = ay - agents.y[agent];
    const detail::Rotation turn = detail::rotation(agents.heading[agent]);
    x = turn.cosine * u + turn.sine * v, y = turn.cosine * v - turn.sine * u;
    from = dx * u + dy * v, to = from + length, offset = dy * u - dx * v;
    slack = 0x1p-49 * (std::abs(dx) + std::abs(dy) + length);
  }

  Point2 local(double at_x, double at_y) const { return {x * at_x + y * at_y, x * at_y - y * at_x - offset}; }
  double square_distance(const Disc& disc) const {
    const Point2 at = local(disc.x, disc.y);
    const double beyond = std::max(std::max(from - at.x, at.x - to), 0.0);
    return at.y * at.y + beyond * beyond;
  }
  bool touches(const Disc& disc) const {
    const double limit = static_cast<double>(disc.radius) + slack;
    return square_distance(disc) <= limit * limit;
  }
};

std::vector<Line> lines_of(const Agents& agents, std::uint32_t agent, const ReferenceObstacle& obstacle) {
  std::vector<Line> lines;
  for (const auto& segment : obstacle.segments) lines.emplace_back(agents, agent, segment);
  return lines;
}

/// Returns whether the obstacle encloses a point of an agent's frame, by even and odd. `turn`: the agent's.
bool encloses(const ReferenceObstacle& obstacle, const Agents& agents, std::uint32_t agent,
              const detail::Rotation& turn, double x, double y) {
  if (!obstacle.is_area) return false;
  const double px = turn.cosine * x - turn.sine * y, py = turn.sine * x + turn.cosine * y;
  bool odd = false;
  for (const auto& [ax, ay, bx, by] : obstacle.segments) {
    const double x0 = ax - agents.x[agent] - px, y0 = ay - agents.y[agent] - py;
    const double x1 = bx - agents.x[agent] - px, y1 = by - agents.y[agent] - py;
    if ((y0 > 0) != (y1 > 0)) odd ^= (x0 * y1 - x1 * y0 > 0) == (y1 > y0);
  }
  return odd;
}

double square_distance(Point2 p, Point2 a, Point2 b) {
  const double x = b.x - a.x, y = b.y - a.y, square = x * x + y * y;
  const double share = square > 0 ? std::clamp(((p.x - a.x) * x + (p.y - a.y) * y) / square, 0.0, 1.0) : 0.0;
  const double dx = p.x - a.x - share * x, dy = p.y - a.y - share * y;
  return dx * dx + dy * dy;
}

/// Returns whether a segment of an outline comes within a margin of a line.
bool meet(const std::array<Point2, 2>& ends, const Line& line, double margin) {
  const Point2 p = line.local(ends[0].x, ends[0].y), q = line.local(ends[1].x, ends[1].y);
  const Point2 a{line.from, 0}, b{line.to, 0};
  const auto side = [&](Point2 end) { return (q.x - p.x) * (end.y - p.y) - (q.y - p.y) * (end.x - p.x); };
  if ((p.y > 0) != (q.y > 0) && (side(a) > 0) != (side(b) > 0)) return true;
  const double limit = margin + line.slack;
  return std::min({square_distance(p, a, b), square_distance(q, a, b), square_distance(a, p, q),
                   square_distance(b, p, q)}) <= limit * limit;
}

}  // namespace

bool ObstacleReference::collides(const Agents& agents, std::uint32_t agent,
                                 const ReferenceObstacle& obstacle) const {
  const std::vector<Line> lines = lines_of(agents, agent, obstacle);
  const detail::Rotation turn = detail::rotation(agents.heading[agent]);
  const auto overlaps = [&](const Disc& disc) {
    return std::any_of(lines.begin(), lines.end(), [&](const Line& line) { return line.touches(disc); }) ||
           encloses(obstacle, agents, agent, turn, disc.x, disc.y);
  };
  const CutList& list = cuts_.list(agents, agent);
  const bool exact = segments_.decide(agents, {agent, agent});
  const Shape& shape = shapes_[agents.shape[agent]];
  const auto outline_overlaps = [&](std::uint32_t node) {
    const auto segments = segments_.segments_of(shape, node);
    if (segments.empty()) return true;
    const double margin = LeafSegments::margin_of(shape);
    return std::any_of(segments.begin(), segments.end(), [&](const std::array<Point2, 2>& ends) {
      return std::any_of(lines.begin(), lines.end(),
                         [&](const Line& line) { return meet(ends, line, margin); }) ||
             encloses(obstacle, agents, agent, turn, ends[0].x, ends[0].y);
    });
  };
  for (std::size_t i = 0; i < list.discs.size(); ++i) {
    const std::span<const Disc> path = list.path(i);
    if (std::all_of(path.begin(), path.end(), overlaps) && (!exact || outline_overlaps(list.nodes[i])))
      return true;
  }
  return false;
}

ObstacleReference::Gap ObstacleReference::gap(const Agents& agents, std::uint32_t agent,
                                              std::span<const ReferenceObstacle> obstacles) const {
  Gap least{std::numeric_limits<double>::infinity(), 0xffffffff, 0xffffffff};
  const std::span<const Disc> discs = cuts_.of(agents, agent);
  std::uint32_t first = 0;
  for (const ReferenceObstacle& obstacle : obstacles) {
    for (const Line& line : lines_of(agents, agent, obstacle)) {
      for (std::uint32_t i = 0; i < discs.size(); ++i) {
        const double gap =
            std::sqrt(line.square_distance(discs[i])) - (static_cast<double>(discs[i].radius) + line.slack);
        if (std::tie(gap, i, first) < std::tie(least.gap, least.disc, least.segment)) least = {gap, i, first};
      }
      ++first;
    }
  }
  return least;
}

bool ObstacleReference::holds_a_centre(const Agents& agents, std::uint32_t agent,
                                       const ReferenceObstacle& obstacle) const {
  const std::span<const Disc> discs = cuts_.of(agents, agent);
  const detail::Rotation turn = detail::rotation(agents.heading[agent]);
  return std::any_of(discs.begin(), discs.end(), [&](const Disc& disc) {
    return encloses(obstacle, agents, agent, turn, disc.x, disc.y);
  });
}

}  // namespace bch::baselines
