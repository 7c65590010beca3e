// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/obstacle_reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "layout/base/heading.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::baselines {
namespace {

/// A segment in an agent's frame: along and across it, and the slack for what is far.
struct Line {
  double x, y, offset, from, to, slack;

  Line(const Agents& agents, std::uint32_t agent, const std::array<double, 4>& segment) {
    const auto [ax, ay, bx, by] = segment;
    const double edge_x = bx - ax, edge_y = by - ay, length = std::sqrt(edge_x * edge_x + edge_y * edge_y);
    const double u = length > 0 ? edge_x / length : 1, v = length > 0 ? edge_y / length : 0;
    const double dx = ax - agents.x[agent], dy = ay - agents.y[agent];
    const detail::Rotation turn = detail::rotation(agents.heading[agent]);
    x = turn.cosine * u + turn.sine * v, y = turn.cosine * v - turn.sine * u;
    from = dx * u + dy * v, to = from + length, offset = dy * u - dx * v;
    slack = 0x1p-49 * (std::abs(dx) + std::abs(dy) + length);
  }

  Point2 local(double at_x, double at_y) const { return {x * at_x + y * at_y, x * at_y - y * at_x - offset}; }
  double square_distance(const Disc& disc) const { return square_distance(local(disc.x, disc.y)); }
  double square_distance(Point2 at) const {
    const double beyond = std::max(std::max(from - at.x, at.x - to), 0.0);
    return at.y * at.y + beyond * beyond;
  }
  double gap(const Disc& disc) const {
    return std::sqrt(square_distance(disc)) - (static_cast<double>(disc.radius) + slack);
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
  const double t = square > 0 ? std::clamp(((p.x - a.x) * x + (p.y - a.y) * y) / square, 0.0, 1.0) : 0.0;
  const double dx = p.x - a.x - t * x, dy = p.y - a.y - t * y;
  return dx * dx + dy * dy;
}

/// Returns the square of the distance of a segment of an outline from a line, 0 where they cross.
double square_distance(const std::array<Point2, 2>& ends, const Line& line) {
  const Point2 p = line.local(ends[0].x, ends[0].y), q = line.local(ends[1].x, ends[1].y);
  const Point2 a{line.from, 0}, b{line.to, 0};
  const auto side = [&](Point2 end) { return (q.x - p.x) * (end.y - p.y) - (q.y - p.y) * (end.x - p.x); };
  if ((p.y > 0) != (q.y > 0) && (side(a) > 0) != (side(b) > 0)) return 0;
  return std::min(
      {line.square_distance(p), line.square_distance(q), square_distance(a, p, q), square_distance(b, p, q)});
}

/// Returns whether a segment of an outline comes within a margin of a line.
bool meet(const std::array<Point2, 2>& ends, const Line& line, double margin) {
  const double limit = margin + line.slack;
  return square_distance(ends, line) <= limit * limit;
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
  return outline_contains(agents, agent, obstacle);
}

bool ObstacleReference::outline_contains(const Agents& agents, std::uint32_t agent,
                                         const ReferenceObstacle& obstacle) const {
  const Outline& outline = shapes_[agents.shape[agent]].outline;
  const detail::Rotation turn = detail::rotation(agents.heading[agent]);
  const auto contains = [&](std::span<const Vec2> contour, double x, double y) {
    bool odd = false;
    Vec2 a = contour.back();
    for (const Vec2 b : contour) {
      const double ax = double{a.x} - x, ay = double{a.y} - y, bx = double{b.x} - x, by = double{b.y} - y;
      if ((ay > 0) != (by > 0)) odd ^= (ax * by - bx * ay > 0) == (by > ay);
      a = b;
    }
    return odd;
  };
  return std::any_of(obstacle.segments.begin(), obstacle.segments.end(), [&](const auto& segment) {
    const double dx = segment[0] - agents.x[agent], dy = segment[1] - agents.y[agent];
    const double x = turn.cosine * dx + turn.sine * dy, y = turn.cosine * dy - turn.sine * dx;
    for (std::size_t i = 0; i < outline.contours(); ++i)
      if (contains(outline.contour(i), x, y)) return true;
    return false;
  });
}

ObstacleReference::Gap ObstacleReference::gap(const Agents& agents, std::uint32_t agent,
                                              std::span<const ReferenceObstacle> obstacles) const {
  Gap least{std::numeric_limits<double>::infinity(), none, none};
  const std::span<const Disc> discs = cuts_.of(agents, agent);
  std::uint32_t first = 0;
  for (const ReferenceObstacle& obstacle : obstacles) {
    for (const Line& line : lines_of(agents, agent, obstacle)) {
      for (std::uint32_t i = 0; i < discs.size(); ++i) {
        const double gap = line.gap(discs[i]);
        if (std::tie(gap, i, first) < std::tie(least.gap, least.disc, least.segment)) least = {gap, i, first};
      }
      ++first;
    }
  }
  return least;
}

ObstacleReference::Gap ObstacleReference::outline_gap(const Agents& agents, std::uint32_t agent,
                                                      std::span<const ReferenceObstacle> obstacles) const {
  if (!segments_.decide(agents, {agent, agent})) return gap(agents, agent, obstacles);
  const CutList& list = cuts_.list(agents, agent);
  const Shape& shape = shapes_[agents.shape[agent]];
  const double margin = LeafSegments::margin_of(shape);
  Gap least{std::numeric_limits<double>::infinity(), none, none};
  const auto take = [&](const Gap& gap) {
    if (std::tie(gap.gap, gap.of_outline, gap.disc, gap.segment) <
        std::tie(least.gap, least.of_outline, least.disc, least.segment))
      least = gap;
  };
  std::map<std::uint32_t, std::array<Point2, 2>> segments;
  std::vector<std::uint32_t> coarse;  // leaves of which discs decide
  for (std::uint32_t i = 0; i < list.discs.size(); ++i) {
    const auto [begin, end] = shape.hierarchy.primitive_ranges[list.nodes[i]];
    if (end - begin > detail::max_leaf_segments) {
      coarse.push_back(i);
      continue;
    }
    for (std::uint32_t k = begin; k < end; ++k) {
      const std::uint32_t number = shape.hierarchy.source[k];
      segments.emplace(number, LeafSegments::segment(shape.outline, number));
    }
  }
  std::uint32_t first = 0;
  for (const ReferenceObstacle& obstacle : obstacles) {
    for (const Line& line : lines_of(agents, agent, obstacle)) {
      for (const auto& [number, ends] : segments)
        take({std::max(std::sqrt(square_distance(ends, line)) - (margin + line.slack), 0.0), 0, first,
              number});
      for (const std::uint32_t i : coarse) take({std::max(line.gap(list.discs[i]), 0.0), i, first});
      ++first;
    }
  }
  return least;
}

bool ObstacleReference::contains_the_outline(const Agents& agents, std::uint32_t agent,
                                             const ReferenceObstacle& obstacle) const {
  if (!segments_.decide(agents, {agent, agent})) return contains_a_centre(agents, agent, obstacle);
  const Shape& shape = shapes_[agents.shape[agent]];
  const detail::Rotation turn = detail::rotation(agents.heading[agent]);
  return std::any_of(shape.outline.points.begin(), shape.outline.points.end(), [&](Vec2 point) {
    return encloses(obstacle, agents, agent, turn, static_cast<double>(point.x),
                    static_cast<double>(point.y));
  });
}

bool ObstacleReference::contains_a_centre(const Agents& agents, std::uint32_t agent,
                                          const ReferenceObstacle& obstacle) const {
  const std::span<const Disc> discs = cuts_.of(agents, agent);
  const detail::Rotation turn = detail::rotation(agents.heading[agent]);
  return std::any_of(discs.begin(), discs.end(), [&](const Disc& disc) {
    return encloses(obstacle, agents, agent, turn, disc.x, disc.y);
  });
}

}  // namespace bch::baselines
