// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/motion/obstacle_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/motion/path.hpp"
#include "layout/base/number_class.hpp"

namespace bch::detail {

double ObstacleSearch::first(const MotionFacts& motion, double from, double to) {
  MovingBody body(motion);
  body_ = &body;
  chunks_tested_ = 0;
  max_extent_ = motion.tree->max_extent;
  limit_.begin();
  for (double time = from; time <= to;) {
    const double end = body_->path_end(time);
    slack_ = body_->time_slack(time) + position_rounding * motion.farthest + root_rounding * 2 * max_extent_;
    // A body that stands still repeats itself after a cycle.
    const bool stands = is_same_pose(body_->pose(time), body_->pose(end));
    const double period = stands ? body_->period(time) : 0,
                 last = period > 0 ? std::min(end, time + 2 * period) : end;
    const double found = first_on_path(time, last, to);
    if (found <= to) return found;
    time = end;
  }
  return never;
}

/// Searches a straight part of the path. Halves it while it is long and obstacles are near.
double ObstacleSearch::first_on_path(double from, double end, double to) {
  limit_.count(1);
  if (from > to || !find_near(from, end)) return never;
  const double half = from + (end - from) / 2;
  const PathKey a = body_->pose(from), b = body_->pose(end);
  const double x = b.x - a.x, y = b.y - a.y;
  if (x * x + y * y <= 4 * max_extent_ * max_extent_ || !(from < half && half < end))
    return first_near(from, end, to);
  const double sooner = first_on_path(from, half, to);
  return sooner < never ? sooner : first_on_path(half, end, to);
}

/// Finds the segments near a part of the path. Returns: whether an obstacle is near.
bool ObstacleSearch::find_near(double from, double end) {
  const PathKey a = body_->pose(from), b = body_->pose(end);
  const std::span<const LocalSegment> found =
      near_.find_along({a.x, a.y, {1, 0}}, {0, 0}, max_extent_ + slack_, {b.x - a.x, b.y - a.y});
  found_.clear();
  for (const LocalSegment& segment : found) found_.push_back(near_.obstacles().segments[segment.slot]);
  return !found_.empty() || is_in_area(a.x, a.y);
}

bool ObstacleSearch::is_in_area(double x, double y) {
  return !near_.areas_containing({x, y, {1, 0}}, {0, 0}).empty();
}

/// Searches key by key of the clip.
double ObstacleSearch::first_near(double from, double end, double to) {
  for (double time = from; time <= to;) {
    limit_.count(1);
    const double until = std::min(body_->clip_end(time), end);
    if (is_inside_at_chunk_begin(time)) return time;
    const double found = first_between(time, is_finite(until) ? until : time + 1);
    if (found < never) return found;
    if (until >= end) return never;
    time = until;
  }
  return never;
}

double ObstacleSearch::first_between(double from, double end) {
  return first_by_bisection(from, end, tolerance_, [&](double begin, double last) {
    limit_.count(found_.size());
    place(begin, last);
    margin_ = nodes_.deviation() + slack_;
    return std::pair(first_of_nodes(), nodes_.deviation());
  });
}

void ObstacleSearch::place(double from, double end) {
  const PathKey a = body_->pose(from), b = body_->pose(end);
  nodes_.place(*body_, {from, 0, 0, a.heading}, {end, b.x - a.x, b.y - a.y, b.heading}, false);
  segments_.clear();
  for (const WorldSegment& s : found_) {
    const double x = s.ax - a.x, y = s.ay - a.y;
    const double slack = position_rounding * (std::abs(x) + std::abs(y) + s.length);
    segments_.push_back({x, y, s.bx - a.x, s.by - a.y, s.x, s.y, s.length, slack});
  }
}

bool ObstacleSearch::is_inside_at_chunk_begin(double time) {
  const std::uint32_t begun = body_->chunks_begun();
  if (near_.obstacles().area_tree.levels == 0 || std::exchange(chunks_tested_, begun) == begun) return false;
  const PathKey pose = body_->pose(time);
  const Rotation turn = rotation(pose.heading);
  const AnimatedTreeChunk& chunk = body_->chunk();
  const KeyPlace at{0, body_->key(), body_->fraction(time)};
  return std::any_of(chunk.leaf_of_disc.begin(), chunk.leaf_of_disc.end(), [&](std::uint32_t leaf) {
    const Disc disc = chunk.disc(at, leaf);
    const double x = disc.x, y = disc.y;
    return is_in_area(pose.x + (turn.cosine * x - turn.sine * y), pose.y + (turn.sine * x + turn.cosine * y));
  });
}

void ObstacleSearch::open(std::uint32_t node, std::uint32_t segment, double last) {
  const StaticSegment& still = segments_[segment];
  const double time = first_overlap(nodes_[node], still, margin_ + still.slack, last);
  if (time <= last) open_.push_back({node, segment, time});
}

/// Nodes that may touch sooner are examined first.
double ObstacleSearch::first_of_nodes() {
  double first = never, last = 1;
  open_.clear();
  for (std::uint32_t i = 0; i < segments_.size(); ++i) open(0, i, last);
  std::size_t sorted = 0;
  while (!open_.empty()) {
    std::sort(open_.begin() + static_cast<std::ptrdiff_t>(sorted), open_.end(),
              [](const Open& x, const Open& y) { return x.time > y.time; });
    const auto [node, segment, time] = open_.back();
    open_.pop_back();
    sorted = open_.size();
    if (time >= first) continue;
    if (nodes_.chunk().is_leaf(node)) {
      first = last = time;
      continue;
    }
    const NodeRange children = nodes_.divide(node);
    for (std::uint32_t child = children.begin; child < children.end; ++child) open(child, segment, last);
  }
  return first;
}

}  // namespace bch::detail
