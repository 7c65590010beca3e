// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/collide/containment.hpp"

#include <algorithm>

#include "kernel/simd/agent_columns.hpp"
#include "kernel/simd/transform.hpp"
#include "layout/base/heading.hpp"
#include "layout/base/rounding.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {
namespace {

using Point = PointIn<double>;
using Placement = TransformOf<double>;

/// Returns the map from the frame of one agent into that of another.
Placement placement(const Arguments& in, std::uint32_t of, std::uint32_t to_agent) {
  const auto number = AgentColumns<void>::number;
  const auto turn = [&](std::uint32_t agent) {
    const double x = number(in.agent_heading, agent);
    return in.agent_heading_y.first == nullptr
               ? rotation(x)
               : rotation(Headings::Value{x, number(in.agent_heading_y, agent), true});
  };
  const Rotation to = turn(to_agent), from = turn(of);
  const double dx = number(in.agent_x, of) - number(in.agent_x, to_agent),
               dy = number(in.agent_y, of) - number(in.agent_y, to_agent);
  return {to.cosine * from.cosine + to.sine * from.sine, to.cosine * from.sine - to.sine * from.cosine,
          to.cosine * dx + to.sine * dy, to.cosine * dy - to.sine * dx};
}

/// Bounds the rounding of one_may_be_inside(), in units of both shapes' extents, with the notation of
/// layout/base/rounding.hpp. The outer disc, as stored, contains its contour. Let c and r be the centre and radius of
/// the inner disc, d the distance of both centres. Three things are rounded:
///
///   - c is rounded to float, by u |c|. That makes d and r larger by as much.
///   - r is rounded up.
///   - The headings are off by 3e-10 each. They place points that are at most 3 S away.
///
/// With |c|^2 + r^2 <= P^2,
///
/// (1)  sqrt(d^2 + r^2) is too large by at most  sqrt(2) u |c| + 2 u r <= 2.45 u P  (centre_and_radius)
/// (2)  placing adds at most                     0.04 u S                           (placing)
///
/// The contour inside has the smaller disc also after rounding. Let v be a vertex on the boundary of the inner disc
/// that is at least r away from the outer disc's centre. The ray from that centre through v leaves the outer contour
/// at a distance of at most the outer radius R. So v and the point where the ray leaves are at most R - r apart. But
/// the cuts do not overlap, so the two points are at least as far apart as the right sides of (3) and (4):
///
/// (3)  discs decide:     R - r >= ((query_margin) - (1' of rounding.hpp)) S, in which (halving) is of the outer shape
///                        alone, because v is a vertex as given                     (between_cuts)
/// (4)  segments decide:  R - r >= ((segment_margin) - (segment_place)) S           (between_segments)
///
/// Both bounds are more than (1) of the inner extent. (So no unit test notices a slack of 0.)
constexpr double inside_slack = 1e-6;
constexpr double centre_and_radius = 2.45, placing = 0.04;  // in units of u
constexpr double between_cuts =
                     rounding::query_margin / rounding::unit_roundoff - rounding::terms::contact_error,
                 between_segments =
                     rounding::segment_margin / rounding::unit_roundoff - rounding::terms::segment_place;
static_assert(rounding::terms::length_within(rounding::terms::root_2, 2, centre_and_radius));
static_assert(inside_slack >= (centre_and_radius + placing) * rounding::unit_roundoff);
static_assert(between_cuts >= rounding::terms::halving && between_cuts > centre_and_radius);
static_assert(between_segments > centre_and_radius);

/// Returns whether the enclosing discs allow that one contour is inside the other: d^2 + r^2 <= R^2. The contour
/// inside has the smaller disc. The points that determine this disc lie in no open half of it. So one of them is in
/// the half that faces away from the outer disc's centre, and is at least sqrt(d^2 + r^2) away from that centre.
/// `b_centre` is the centre of b in a's frame.
bool one_may_be_inside(const Disc& a, const Disc& b, Point b_centre, double slack) {
  const double x = b_centre.x - static_cast<double>(a.x), y = b_centre.y - static_cast<double>(a.y);
  const double r = std::min(a.radius, b.radius), limit = double{std::max(a.radius, b.radius)} + slack;
  return x * x + y * y + r * r <= limit * limit;
}

/// Names a contour of an agent's shape.
struct Owned {
  std::uint32_t agent;
  const Contour& contour;
};

bool contains(const Arguments& in, const Owned& outer, const Owned& inner) {
  const Vec2* const points = in.shapes->points;
  const Vec2 first = points[inner.contour.begin];
  const Placement place = placement(in, inner.agent, outer.agent);
  return contour_contains(points, outer.contour, place.apply(double{first.x}, double{first.y}));
}

}  // namespace

/// By the parity of the edges to its right. Whiskers have each edge twice, in both directions, and cancel.
bool contour_contains(const Vec2* points, const Contour& contour, PointIn<double> p) noexcept {
  bool odd = false;
  for (std::uint32_t i = contour.begin, before = contour.end - 1; i < contour.end; before = i++) {
    const double ax = points[before].x, ay = points[before].y;
    const double bx = points[i].x, by = points[i].y;
    if ((ay > p.y) == (by > p.y)) continue;
    const double side = (bx - ax) * (p.y - ay) - (by - ay) * (p.x - ax);
    odd ^= (by > ay) == (side > 0);
  }
  return odd;
}

bool one_contains_other(const Arguments& in, Pair pair) noexcept {
  const ShapeSetView& shapes = *in.shapes;
  const auto [agent_a, agent_b] = pair;
  const auto shape_of = [&](std::uint32_t agent) {
    return AgentColumns<void>::at<std::uint32_t>(in.agent_shape, agent);
  };
  const std::uint32_t shape_a = shape_of(agent_a), shape_b = shape_of(agent_b);
  const double slack =
      inside_slack * (double{shapes.max_extent[shape_a]} + double{shapes.max_extent[shape_b]});
  const Placement b_in_a = placement(in, agent_b, agent_a);
  const ContourRange of_a = shapes.shape_contours[shape_a], of_b = shapes.shape_contours[shape_b];
  for (std::uint32_t j = of_b.begin; j < of_b.end; ++j) {
    const Owned b{agent_b, shapes.contours[j]};
    const Point centre = b_in_a.apply(double{b.contour.disc.x}, double{b.contour.disc.y});
    for (std::uint32_t i = of_a.begin; i < of_a.end; ++i) {
      const Owned a{agent_a, shapes.contours[i]};
      if (!one_may_be_inside(a.contour.disc, b.contour.disc, centre, slack)) continue;
      const bool is_b_larger = b.contour.disc.radius > a.contour.disc.radius;
      if (is_b_larger ? contains(in, b, a) : contains(in, a, b)) return true;
    }
  }
  return false;
}

}  // namespace bch::detail
