// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/workload/outline_contacts.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <bch/pose_shape.hpp>

#include "baselines/exact_tests.hpp"
#include "bench/placing/placing.hpp"
#include "layout/base/heading.hpp"
#include "layout/base/ring_edges.hpp"
#include "layout/shape_set/animated_tree.hpp"

namespace bch::bench {
namespace {

using baselines::Point2;
using baselines::Segment2;

constexpr double never_meeting = std::numeric_limits<double>::infinity();
constexpr double looks_per_second = 1000;

struct Box {
  Point2 low{never_meeting, never_meeting}, high{-never_meeting, -never_meeting};

  void add(const Point2& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)}, high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  bool meets(const Box& other) const {
    return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y && other.low.y <= high.y;
  }
};

Box box_of(const Segment2& edge) {
  Box box;
  box.add(edge.a), box.add(edge.b);
  return box;
}

/// An outline somewhere in the world, and of its edges those that may matter.
class PlacedOutline {
 public:
  void place(const Outline& outline, double x, double y, double heading) {
    const detail::Rotation turn = detail::rotation(heading);
    const baselines::Placement placement{turn.cosine, turn.sine, x, y};
    const auto placed = [&](std::uint32_t i) { return placement.place(outline.points[i]); };
    edges_.clear(), parts_.clear(), box_ = {};
    for (std::size_t i = 0; i < outline.contours(); ++i) parts_.push_back(placed(outline.contour_begin[i]));
    detail::for_each_ring_edge(std::span(outline.contour_begin).subspan(1),
                               [&](std::uint32_t i, std::uint32_t next) {
                                 edges_.push_back({placed(i), placed(next)});
                                 box_.add(edges_.back().a);
                               });
  }

  const Box& box() const { return box_; }

  /// Takes the edges that meet a box.
  /// Returns: the box about these.
  Box look_near(const Box& box) {
    Box about;
    near_.clear();
    for (const Segment2& edge : edges_)
      if (const Box own = box_of(edge); own.meets(box))
        near_.push_back(edge), about.add(edge.a), about.add(edge.b);
    return about;
  }

  /// Returns whether edges taken of both meet.
  bool crosses(const PlacedOutline& other) const {
    for (const Segment2& edge : near_)
      for (const Segment2& its : other.near_)
        if (box_of(edge).meets(box_of(its)) && baselines::segments_meet(edge, its)) return true;
    return false;
  }

  /// Returns whether a contour of another one begins within this one.
  bool holds_part_of(const PlacedOutline& other) const {
    return std::any_of(other.parts_.begin(), other.parts_.end(), [&](const Point2& p) {
      Box point;
      point.add(p);
      return point.meets(box_) && holds(p);
    });
  }

 private:
  bool holds(const Point2& p) const {
    bool inside = false;
    for (const auto& [a, b] : edges_)
      if ((a.y > p.y) != (b.y > p.y)) inside ^= (baselines::orientation(a, b, p) > 0) == (b.y > a.y);
    return inside;
  }

  std::vector<Segment2> edges_, near_;
  std::vector<Point2> parts_;  ///< where contours begin
  Box box_;
};

bool meet(PlacedOutline& a, PlacedOutline& b) {
  if (!a.box().meets(b.box())) return false;
  a.look_near(b.look_near(a.look_near(b.box())));
  return a.crosses(b) || a.holds_part_of(b) || b.holds_part_of(a);
}

/// The outlines of a clip.
class ClipOutlines {
 public:
  explicit ClipOutlines(const AnimatedClip& clip) : tree_(clip.shape.tree()) {
    PoseShaper shaper(*clip.character);
    const auto count = static_cast<std::size_t>(std::lround(clip.seconds * looks_per_second));
    for (std::size_t k = 0; k < count; ++k) {
      const auto time = static_cast<float>(static_cast<double>(k) / looks_per_second);
      outlines_.push_back(shaper.make_outlines({clip.clip, time}).outline);
      double square = 0;
      for (const Vec2& p : outlines_.back().points)
        square = std::max(square, double{p.x} * double{p.x} + double{p.y} * double{p.y});
      radii_.push_back(std::sqrt(square));
    }
  }

  /// Returns which outline is shown at a time since the clip was at its beginning.
  std::size_t index(double seconds) const {
    const double in_clip = detail::time_in_clip(tree_, seconds);
    return static_cast<std::size_t>(std::lround(in_clip * looks_per_second)) % outlines_.size();
  }
  const Outline& outline(std::size_t index) const { return outlines_[index]; }
  /// Returns the radius of the circle about the agent that holds an outline.
  double radius(std::size_t index) const { return radii_[index]; }

 private:
  const detail::AnimatedTree& tree_;
  std::vector<Outline> outlines_;
  std::vector<double> radii_;
};

/// A motion, and the outlines that it shows.
struct Shown {
  const Motion& motion;
  const ClipOutlines& outlines;
};

/// Returns the first sample at which the outlines of two meet, or infinity.
double first_meeting(const Shown& a, const Shown& b, std::uint64_t& compared) {
  PlacedOutline of_a, of_b;
  for (std::size_t k = 0; k <= static_cast<std::size_t>(MotionScene::seconds * looks_per_second); ++k) {
    const double time = static_cast<double>(k) / looks_per_second;
    const PathKey key_a = at(a.motion.path, time), key_b = at(b.motion.path, time);
    const double x = key_b.x - key_a.x, y = key_b.y - key_a.y;
    const std::size_t in_a = a.outlines.index(time - a.motion.clip_begin),
                      in_b = b.outlines.index(time - b.motion.clip_begin);
    if (std::hypot(x, y) > a.outlines.radius(in_a) + b.outlines.radius(in_b)) continue;
    ++compared;
    of_a.place(a.outlines.outline(in_a), 0, 0, key_a.heading);
    of_b.place(b.outlines.outline(in_b), x, y, key_b.heading);
    if (meet(of_a, of_b)) return time;
  }
  return never_meeting;
}

}  // namespace

OutlineContacts outline_contacts(const MotionScene& scene) {
  std::vector<std::optional<ClipOutlines>> clips(scene.clips().size());
  tbb::parallel_for(std::size_t{0}, clips.size(), [&](std::size_t i) { clips[i].emplace(scene.clips()[i]); });
  std::vector<double> meetings(scene.pairs().size());
  std::vector<std::uint64_t> compared(meetings.size());
  tbb::parallel_for(std::size_t{0}, meetings.size(), [&](std::size_t i) {
    const auto shown = [&](std::uint32_t motion) {
      return Shown{scene.motions()[motion], *clips[scene.clip(motion)]};
    };
    const auto [first, second] = scene.pairs()[i];
    meetings[i] = first_meeting(shown(first), shown(second), compared[i]);
  });
  OutlineContacts found;
  for (std::size_t i = 0; i < meetings.size(); ++i) {
    found.compared += compared[i];
    if (meetings[i] == never_meeting) continue;
    const double ahead = meetings[i] - scene.contacts()[i];
    ++found.meeting;
    if (ahead < 0)
      ++found.late, found.latest = std::max(found.latest, -ahead);
    else
      found.ahead += ahead;
  }
  if (found.meeting > found.late) found.ahead /= static_cast<double>(found.meeting - found.late);
  return found;
}

}  // namespace bch::bench
