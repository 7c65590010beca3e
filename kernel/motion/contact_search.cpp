// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/motion/contact_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "kernel/motion/hull_separation.hpp"
#include "kernel/motion/path.hpp"
#include "layout/base/number_class.hpp"

namespace bch::detail {
namespace {

constexpr double max_band_slack = hull_overlap / 4;  ///< metres

/// Slopes of the lines along which bands are compared: the tangents of multiples of 22.5 degrees.
constexpr double slopes[] = {0, 0.4142, -0.4142, 1, -1, 2.4142, -2.4142};

/// The motion of body a relative to body b between two times, mapped to 0 to 1.
struct RelativeMotion {
  double x, y, z, move_x, move_y, move_z;

  RelativeMotion(const PathKey& a, const PathKey& b, const PathKey& a_end, const PathKey& b_end)
      : x(a.x - b.x),
        y(a.y - b.y),
        z(a.z - b.z),
        move_x(a_end.x - b_end.x - x),
        move_y(a_end.y - b_end.y - y),
        move_z(a_end.z - b_end.z - z) {}

  double distance() const noexcept { return std::sqrt(x * x + y * y); }

  /// Returns the interval in which both of the following conditions hold; never, if there is none.
  std::pair<double, double> times_within(double radius, double height) const noexcept {
    const auto [enter, leave] = times_within(radius);
    const auto [from, to] = times_level(height);
    const double first = std::max(enter, from), last = std::min(leave, to);
    return first <= last ? std::pair(first, last) : std::pair(never, never);
  }

  /// Returns the interval in which the heights differ by at most `height`; never, if there is none.
  std::pair<double, double> times_level(double height) const noexcept {
    if (std::abs(z) <= height && std::abs(z + move_z) <= height) return {0, 1};
    if (move_z == 0) return {never, never};
    const double one = (-height - z) / move_z, other = (height - z) / move_z;
    const double from = std::max(std::min(one, other), 0.0), to = std::min(std::max(one, other), 1.0);
    return from <= to ? std::pair(from, to) : std::pair(never, never);
  }

  /// Returns the interval in which the distance seen from above is at most `radius`; never, if there is none.
  std::pair<double, double> times_within(double radius) const noexcept {
    const double a = move_x * move_x + move_y * move_y, b = x * move_x + y * move_y,
                 c = x * x + y * y - radius * radius, across = x * move_y - y * move_x;
    const double square = a * radius * radius - across * across;  // b^2 - a c, accurate on long paths, too
    if (c > 0 && (b >= 0 || square < 0)) return {never, never};
    if (!(a > 0)) return {0, 1};
    const double root = std::sqrt(std::max(square, 0.0));
    return {c > 0 ? c / (root - b) : 0, std::min((root - b) / a, 1.0)};
  }
};

}  // namespace

double ContactSearch::first(const MotionFacts& a, const MotionFacts& b, double from, double to) {
  MovingBody body_a(a), body_b(b);
  a_ = &body_a, b_ = &body_b;
  limit_.begin();
  in_space_ = a.tree->in_space && b.tree->in_space;
  const double max_extents = a.tree->max_extent + b.tree->max_extent,
               heights = in_space_ ? a.tree->height + b.tree->height : never;
  const double position_slack = position_rounding * (a.farthest + b.farthest) +
                                root_rounding * (max_extents + (in_space_ ? heights : 0));
  for (double time = from; time <= to;) {
    const double end = std::min(a_->path_end(time), b_->path_end(time));
    const double until = is_finite(end) ? end : to + 1;
    slack_ = position_slack + (a_->time_slack(time) + b_->time_slack(time));
    const RelativeMotion relative(a_->pose(time), b_->pose(time), a_->pose(until), b_->pose(until));
    const auto [enter, leave] = relative.times_within(max_extents + slack_, heights + slack_);
    limit_.count(1);
    if (enter <= 1) {
      const double length = until - time,
                   last = leave < 1 ? time + leave * length : std::min(end, end_of_two_cycles(time, until));
      const double found =
          first_near(std::min(time + enter * length, last), last, to, AnimatedHulls::level_count);
      if (found <= to) return found;
      time = end;
    } else {
      // Too far apart until both have approached at their greatest speeds.
      const double gap = relative.distance() - max_extents - slack_, speed = a.path_speed + b.path_speed;
      const bool waits = gap > 0 && speed > 0;
      time = std::max(end, waits ? std::nextafter(time + gap / speed * (1 - root_rounding), time) : end);
    }
  }
  return never;
}

/// Returns the end of two common cycles of two bodies that stand still in [time, until]: later they only
/// repeat themselves. Never, if they have no common cycle.
double ContactSearch::end_of_two_cycles(double time, double until) {
  const bool stand =
      is_same_pose(a_->pose(time), a_->pose(until)) && is_same_pose(b_->pose(time), b_->pose(until));
  if (!stand) return never;
  const double a = a_->period(time), b = b_->period(time);
  const double together = a == 0 || b == 0 || a == b ? std::max(a, b) : never;
  return together > 0 ? time + 2 * together : never;
}

/// Searches an interval in which both paths are straight and the bodies within reach, window by window of
/// their hulls at `level`, or key by key at level 0.
double ContactSearch::first_near(double from, double end, double to, unsigned level) {
  for (double time = from; time <= to;) {
    if (level > 0) limit_.count(1);
    const double clip_end = std::min(a_->clip_end(time), b_->clip_end(time));
    double until = std::min(end, clip_end), found = never;
    if (level > 0) until = std::min({end, a_->hull_end(level - 1), b_->hull_end(level - 1)});
    const double last = is_finite(until) ? until : time + 1;
    if (level == 0) {
      found = first_between(time, last);
    } else if (!hulls_are_apart(time, last, level - 1)) {
      found = first_near(time, until, to, level - 1);
    }
    if (found < never || until >= end) return found;
    time = until;
  }
  return never;
}

/// Compares the hulls along the line between the positions at their least distance; along this line, the
/// distance is linear in time. For bodies of spheres, it suffices that a line separates them in each band of
/// height: this line or one of several rotated ones.
bool ContactSearch::hulls_are_apart(double from, double end, unsigned level) const {
  const PathKey a = a_->pose(from), b = b_->pose(from), a_end = a_->pose(end), b_end = b_->pose(end);
  const PlanePoint between{b.x - a.x, b.y - a.y}, at_end{b_end.x - a_end.x, b_end.y - a_end.y},
      relative = at_end - between;
  const double square = squared_length(relative);
  const double nearest = square > 0 ? std::clamp(-dot(between, relative) / square, 0.0, 1.0) : 0;
  const PlanePoint line = between + nearest * relative;
  if (squared_length(line) == 0) return false;
  const auto along = [&](double slope) {
    const PlanePoint direction = line + slope * PlanePoint{-line.y, line.x};
    return SeparatingLine{{*a_, level, a, a_end, direction},
                          {*b_, level, b, b_end, -1 * direction},
                          dot(between, direction) - slack_ * length(direction),
                          dot(at_end, direction) - slack_ * length(direction)};
  };
  std::array<std::optional<SeparatingLine>, std::size(slopes)> lines;
  lines[0].emplace(along(slopes[0]));
  if (lines[0]->separates(a_->hull(level).extents, b_->hull(level).extents)) return true;
  if (!in_space_ || slack_ > max_band_slack) return false;
  const auto are_apart = [&](const HullInterval::Extents& of_a, const HullInterval::Extents& of_b) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (!lines[i]) lines[i].emplace(along(slopes[i]));
      if (lines[i]->separates(of_a, of_b)) return true;
    }
    return false;
  };
  const auto [low, high] = std::minmax({a.z - b.z, a_end.z - b_end.z});
  const HullBands &bands_a = a_->bands(level), &bands_b = b_->bands(level);
  for (std::uint32_t i = 0; i < hull_bands; ++i)
    for (std::uint32_t j = 0; j < hull_bands; ++j)
      if ((bands_a.occupied >> i & 1) != 0 && (bands_b.occupied >> j & 1) != 0 &&
          bands_overlap(i, j, low, high) && !are_apart(bands_a.extents[i], bands_b.extents[j]))
        return false;
  return true;
}

double ContactSearch::first_between(double from, double end) {
  return first_by_bisection(from, end, tolerance_, [&](double begin, double last) {
    limit_.count(1);
    place(begin, last);
    const double deviation = nodes_a_.deviation() + nodes_b_.deviation();
    margin_ = deviation + slack_;
    return std::pair(first_of_nodes(), deviation);
  });
}

void ContactSearch::place(double from, double end) {
  const PathKey a = a_->pose(from), b = b_->pose(from), a_end = a_->pose(end), b_end = b_->pose(end);
  nodes_a_.place(*a_, {from, a.x - b.x, a.y - b.y, a.heading, a.z - b.z},
                 {end, a_end.x - b_end.x, a_end.y - b_end.y, a_end.heading, a_end.z - b_end.z}, in_space_);
  nodes_b_.place(*b_, {from, 0, 0, b.heading}, {end, 0, 0, b_end.heading}, in_space_);
}

/// Nodes that may touch sooner are examined first.
double ContactSearch::first_of_nodes() {
  const AnimatedTreeChunk &a = nodes_a_.chunk(), &b = nodes_b_.chunk();
  double first = never, last = 1;
  open_.clear();
  const double of_roots = first_overlap(nodes_a_[0], nodes_b_[0], margin_, last);
  if (of_roots <= last) open_.push_back({0, 0, of_roots});
  while (!open_.empty()) {
    const Open at = open_.back();
    const std::uint32_t i = at.i, j = at.j;
    open_.pop_back();
    if (at.time >= first) continue;
    const bool leaf_a = a.is_leaf(i), leaf_b = b.is_leaf(j);
    if (leaf_a && leaf_b) {
      first = last = at.time;
    } else if (leaf_b || (!leaf_a && nodes_a_.radius(i) >= nodes_b_.radius(j))) {
      open_children(nodes_a_, i, nodes_b_[j], last, [j](std::uint32_t child, double time) {
        return Open{child, j, time};
      });
    } else {
      open_children(nodes_b_, j, nodes_a_[i], last, [i](std::uint32_t child, double time) {
        return Open{i, child, time};
      });
    }
  }
  return first;
}

template <class Make>
void ContactSearch::open_children(PlacedNodes& nodes, std::uint32_t node, const MovingDisc& other,
                                  double last, Make make) {
  const NodeRange children = nodes.divide(node);
  const std::size_t before = open_.size();
  std::array<double, animated_width> times;
  nodes.first_overlaps(children.begin, other, margin_, last, times);
  for (std::uint32_t child = children.begin; child < children.end; ++child) {
    const double time = times[child - children.begin];
    if (!(time <= last)) continue;
    open_.push_back(make(child, time));
    for (std::size_t i = open_.size() - 1; i > before && open_[i - 1].time < time; --i)
      std::swap(open_[i - 1], open_[i]);
  }
}

}  // namespace bch::detail
