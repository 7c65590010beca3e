// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/containment.hpp"

#include "layout/heading.hpp"

namespace bch::kernel {
namespace {

struct Point {
  double x, y;
};

/// From the frame of one agent into that of another.
struct Placement {
  Rotation turn;
  Point origin;

  Point operator()(Vec2 p) const {
    const double x = p.x, y = p.y;
    return {origin.x + (turn.cosine * x - turn.sine * y), origin.y + (turn.sine * x + turn.cosine * y)};
  }
};

Placement placement(const Agents& agents, std::uint32_t of, std::uint32_t in) {
  const Rotation to = rotation(agents.heading[in]), from = rotation(agents.heading[of]);
  const double dx = agents.x[of] - agents.x[in], dy = agents.y[of] - agents.y[in];
  return {{to.cosine * from.cosine + to.sine * from.sine, to.cosine * from.sine - to.sine * from.cosine},
          {to.cosine * dx + to.sine * dy, to.cosine * dy - to.sine * dx}};
}

/// By the parity of the edges to the right of p. Whiskers are walked there and back and cancel.
bool inside(const Vec2* points, const Contour& contour, Point p) {
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

/// A contour inside another has the smaller enclosing disc, and more: the points that hold its disc in place
/// do not fit into any half of it, so one of them is at least sqrt(d^2 + r^2) away from the other disc's
/// centre.
bool may_be_inside(const Disc& outer, const Disc& inner, Point inner_centre, double slack) {
  const double x = inner_centre.x - static_cast<double>(outer.x),
               y = inner_centre.y - static_cast<double>(outer.y);
  const double r = inner.radius, limit = static_cast<double>(outer.radius) + slack;
  return x * x + y * y + r * r <= limit * limit;
}

bool contains_contour_of(const ShapeSetView& shapes, std::uint32_t outer_shape, std::uint32_t inner_shape,
                         const Placement& place) {
  // The discs' centres and radii are rounded to float, 2 u of the reach each.
  const double slack = 1e-6 * (static_cast<double>(shapes.reach[outer_shape]) +
                               static_cast<double>(shapes.reach[inner_shape]));
  const ContourRange outer = shapes.shape_contours[outer_shape], inner = shapes.shape_contours[inner_shape];
  for (std::uint32_t i = inner.begin; i < inner.end; ++i) {
    const Contour& within = shapes.contours[i];
    const Point centre = place({within.disc.x, within.disc.y});
    for (std::uint32_t o = outer.begin; o < outer.end; ++o)
      if (may_be_inside(shapes.contours[o].disc, within.disc, centre, slack) &&
          inside(shapes.points, shapes.contours[o], place(shapes.points[within.begin])))
        return true;
  }
  return false;
}

}  // namespace

bool one_contains_other(const ShapeSetView& shapes, const Agents& agents, Pair pair) noexcept {
  const auto [a, b] = pair;
  return contains_contour_of(shapes, agents.shape[a], agents.shape[b], placement(agents, b, a)) ||
         contains_contour_of(shapes, agents.shape[b], agents.shape[a], placement(agents, a, b));
}

}  // namespace bch::kernel
