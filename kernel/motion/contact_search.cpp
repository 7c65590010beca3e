// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/motion/contact_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "layout/base/ring_edges.hpp"

namespace bch::detail {
namespace {

constexpr double time_rounding = 0x1p-27, position_rounding = 0x1p-48, root_rounding = 0x1p-20;
constexpr double unsure_share = 0.5;

/// The way of one body relative to another between two times.
struct RelativeWay {
  double x, y, way_x, way_y;

  RelativeWay(const PathKey& a, const PathKey& b, const PathKey& a_end, const PathKey& b_end)
      : x(a.x - b.x), y(a.y - b.y), way_x(a_end.x - b_end.x - x), way_y(a_end.y - b_end.y - y) {}

  double distance() const noexcept { return std::sqrt(x * x + y * y); }

  /// Returns between which times, of 0 to 1, the distance is at most a radius; never, where there is none.
  std::pair<double, double> times_within(double radius) const noexcept {
    const double a = way_x * way_x + way_y * way_y, b = x * way_x + y * way_y,
                 c = x * x + y * y - radius * radius;
    const double square = b * b - a * c;
    if (c > 0 && (b >= 0 || square < 0)) return {never, never};
    if (!(a > 0)) return {0, 1};
    const double root = std::sqrt(std::max(square, 0.0));
    return {c > 0 ? c / (root - b) : 0, std::min((root - b) / a, 1.0)};
  }
};

/// Returns how often the rings of a body go round a point in the beginning of the interval in which it is placed.
int winding(PlacedNodes& nodes, double x, double y) {
  const AnimatedTreeChunk& chunk = nodes.chunk();
  int winding = 0;
  for_each_ring_edge(chunk.ring_ends, [&](std::uint32_t i, std::uint32_t next) {
    const MovingDisc &from = nodes[chunk.leaf_of_disc[i]], &to = nodes[chunk.leaf_of_disc[next]];
    if ((from.y <= y) == (to.y <= y)) return;
    const double side = (to.x - from.x) * (y - from.y) - (x - from.x) * (to.y - from.y);
    if ((side > 0) == (to.y > y)) winding += to.y > y ? 1 : -1;
  });
  return winding;
}

/// Returns whether one body holds a ring of another in the beginning, or one of its discs where it has no rings.
bool holds(PlacedNodes& around, PlacedNodes& inside) {
  if (around.chunk().ring_ends.empty()) return false;
  const AnimatedTreeChunk& chunk = inside.chunk();
  const MovingDisc root = around[0];
  const auto holds_disc = [&](std::uint32_t i) {
    const MovingDisc& disc = inside[chunk.leaf_of_disc[i]];
    const double x = disc.x - root.x, y = disc.y - root.y;
    return x * x + y * y <= root.radius * root.radius && winding(around, disc.x, disc.y) != 0;
  };
  if (chunk.ring_ends.empty()) {
    for (std::uint32_t i = 0; i < chunk.leaf_of_disc.size(); ++i)
      if (holds_disc(i)) return true;
    return false;
  }
  return std::any_of(chunk.ring_ends.begin(), chunk.ring_ends.end(),
                     [&](std::uint32_t end) { return holds_disc(end - 1); });
}

}  // namespace

double ContactSearch::first(const MotionFacts& a, const MotionFacts& b, double from, double to) {
  MovingBody body_a(a), body_b(b);
  a_ = &body_a, b_ = &body_b;
  looked_inside_ = 0;
  reach_a_ = a.tree->reach, reach_b_ = b.tree->reach;
  const double reaches = reach_a_ + reach_b_;
  slack_ = time_rounding * (a.speed + b.speed) + position_rounding * (a.farthest + b.farthest) +
           root_rounding * reaches;
  for (double time = from; time <= to;) {
    const double end = std::min(a_->path_end(time), b_->path_end(time));
    const double until = std::isfinite(end) ? end : to + 1;
    const RelativeWay way(a_->pose(time), b_->pose(time), a_->pose(until), b_->pose(until));
    const auto [enter, leave] = way.times_within(reaches + slack_);
    if (enter <= 1) {
      const double length = until - time, last = leave < 1 ? time + leave * length : end;
      const double found = first_near(std::min(time + enter * length, last), last, to, window_levels - 1);
      if (found <= to) return found;
      time = end;
    } else {
      // Farther apart, and that for as long as both take at their greatest speed.
      const double gap = way.distance() - reaches - slack_, speed = a.path_speed + b.path_speed;
      time = std::max(end, gap > 0 && speed > 0 ? time + gap / speed * (1 - root_rounding) : end);
    }
  }
  return never;
}

/// Where both paths go straight on and the bodies are within reach: from window to window of the clips' keys.
double ContactSearch::first_near(double from, double end, double to, unsigned level) {
  for (double time = from; time <= to;) {
    a_->clip_end(time), b_->clip_end(time);
    if (nested_where_a_chunk_begins(time)) return time;
    const double until = std::min({a_->window_end(level), b_->window_end(level), end});
    const double found = first_between(time, std::isfinite(until) ? until : time + 1, to, level);
    if (found < never || until >= end) return found;
    time = until;
  }
  return never;
}

/// Windows of more than a key tell where there is no contact, and from when on there may be one.
double ContactSearch::first_between(double from, double end, double to, unsigned level) {
  place(from, end, level);
  const double bend = nodes_a_.bend() + nodes_b_.bend();
  room_ = bend + slack_;
  const double found = first_of_nodes(level);
  if (found == never) return never;
  const double time = std::min(from + found * (end - from), end), half = time + (end - time) / 2;
  if (level > 0) return first_near(time, end, to, level - 1);
  if (2 * bend <= tolerance_ || !(time < half && half < end)) return time;
  const double sooner = first_between(time, half, to, 0);
  return sooner < never ? sooner : first_between(half, end, to, 0);
}

void ContactSearch::place(double from, double end, unsigned level) {
  const PathKey a = a_->pose(from), b = b_->pose(from), a_end = a_->pose(end), b_end = b_->pose(end);
  nodes_a_.place(*a_, level, reach_a_, {from, a.x - b.x, a.y - b.y, a.heading},
                 {end, a_end.x - b_end.x, a_end.y - b_end.y, a_end.heading});
  nodes_b_.place(*b_, level, reach_b_, {from, 0, 0, b.heading}, {end, 0, 0, b_end.heading});
}

bool ContactSearch::nested_where_a_chunk_begins(double time) {
  const std::uint32_t begun = a_->chunks_begun() + b_->chunks_begun();
  if (std::exchange(looked_inside_, begun) == begun) return false;
  place(time, time, 0);
  return holds(nodes_a_, nodes_b_) || holds(nodes_b_, nodes_a_);
}

void ContactSearch::open(std::uint32_t i, std::uint32_t j, double last) {
  const double time = first_touch(i, j, last);
  if (time <= last) open_.push_back({i, j, time});
}

/// Returns whether two nodes may only touch because of what the keys of their windows depart from straight ways.
bool ContactSearch::is_unsure(std::uint32_t i, std::uint32_t j) {
  const double radii = nodes_a_[i].radius + nodes_b_[j].radius;
  return nodes_a_.spare(i) + nodes_b_.spare(j) + room_ > unsure_share * radii;
}

/// What may touch sooner is looked at first. In windows of more than a key it is enough to know when the roots touch.
double ContactSearch::first_of_nodes(unsigned level) {
  const AnimatedTreeChunk &a = nodes_a_.chunk(), &b = nodes_b_.chunk();
  double first = never, last = 1;
  open_.clear();
  open(0, 0, last);
  const double of_roots = open_.empty() ? never : open_[0].time;
  while (!open_.empty()) {
    const auto [i, j, time] = open_.back();
    open_.pop_back();
    if (time >= first) continue;
    const bool leaf_a = a.is_leaf(i), leaf_b = b.is_leaf(j);
    if (level > 0 && ((leaf_a && leaf_b) || is_unsure(i, j))) return of_roots;
    if (leaf_a && leaf_b) {
      first = last = time;
      continue;
    }
    const std::size_t before = open_.size();
    const bool divide_a = leaf_b || (!leaf_a && nodes_a_[i].radius >= nodes_b_[j].radius);
    const NodeRange children = divide_a ? a.children(i) : b.children(j);
    for (std::uint32_t child = children.begin; child < children.end; ++child)
      divide_a ? open(child, j, last) : open(i, child, last);
    std::sort(open_.begin() + static_cast<std::ptrdiff_t>(before), open_.end(),
              [](const Open& x, const Open& y) { return x.time > y.time; });
  }
  return first;
}

}  // namespace bch::detail
