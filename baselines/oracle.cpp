// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/oracle.hpp"

#include <algorithm>
#include <cmath>

namespace bch::baselines {
namespace {

/// Calls visit(a, b) for the segments of every contour, the closing one included.
template <class Contours, class Visit>
bool any_segment(const Contours& contours, Visit visit) {
  for (const auto& contour : contours)
    for (std::size_t i = 0; i < contour.size(); ++i)
      if (visit(contour[i], contour[(i + 1) % contour.size()])) return true;
  return false;
}

}  // namespace

ExactPlacement exact_placement(const Agents& agents, std::uint32_t a, std::uint32_t b) {
  const auto angle = [&](std::uint32_t agent) {
    const auto [x, y, is_direction] = agents.heading[agent];
    return is_direction ? std::atan2(static_cast<long double>(y), static_cast<long double>(x))
                        : static_cast<long double>(x);
  };
  const long double to = angle(a), turn = angle(b) - to;
  const long double dx = static_cast<long double>(agents.x[b]) - static_cast<long double>(agents.x[a]);
  const long double dy = static_cast<long double>(agents.y[b]) - static_cast<long double>(agents.y[a]);
  const long double c = std::cos(to), s = std::sin(to);
  return {std::cos(turn), std::sin(turn), c * dx + s * dy, c * dy - s * dx};
}

Oracle::Oracle(const Outline& a, const Outline& b, const ExactPlacement& place) {
  for (std::size_t i = 0; i < a.contours(); ++i) {
    Contour& contour = a_.emplace_back();
    for (const Vec2& p : a.contour(i)) contour.push_back({p.x, p.y});
  }
  for (std::size_t i = 0; i < b.contours(); ++i) {
    Contour& contour = b_.emplace_back();
    for (const Vec2& p : b.contour(i)) {
      const long double x = p.x, y = p.y;
      contour.push_back(
          {place.x + place.cosine * x - place.sine * y, place.y + place.sine * x + place.cosine * y});
    }
  }
}

bool Oracle::segments_meet(Point a, Point b, Point p, Point q) {
  // Boxes first: they settle most pairs, and collinear segments, which pass every test below.
  if (std::max(a.x, b.x) < std::min(p.x, q.x) || std::max(p.x, q.x) < std::min(a.x, b.x) ||
      std::max(a.y, b.y) < std::min(p.y, q.y) || std::max(p.y, q.y) < std::min(a.y, b.y))
    return false;
  const auto side = [](Point from, Point to, Point of) {
    return (to.x - from.x) * (of.y - from.y) - (to.y - from.y) * (of.x - from.x);
  };
  const long double p_side = side(a, b, p), q_side = side(a, b, q), a_side = side(p, q, a),
                    b_side = side(p, q, b);
  return !((p_side > 0 && q_side > 0) || (p_side < 0 && q_side < 0) || (a_side > 0 && b_side > 0) ||
           (a_side < 0 && b_side < 0));
}

long double Oracle::distance(Point p, Point a, Point b) {
  const long double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
  const long double t =
      square > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / square, 0.0L, 1.0L) : 0.0L;
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

/// Returns the time t at which p, moving by t (x, y), reaches a segment. Returns infinity if the two are
/// parallel: p then meets the end of a neighbouring segment.
long double Oracle::arrival(Point p, long double x, long double y, Point a, Point b) {
  const long double dx = b.x - a.x, dy = b.y - a.y, across = x * dy - y * dx;
  if (across == 0) return HUGE_VALL;
  const long double t = ((a.x - p.x) * dy - (a.y - p.y) * dx) / across;
  const long double along = ((a.x - p.x) * y - (a.y - p.y) * x) / across;
  return t >= 0 && t <= 1 && along >= 0 && along <= 1 ? t : HUGE_VALL;
}

/// Returns whether p is inside, by the winding number. The kernels count parity, and the two agree because
/// contours do not contain each other.
bool Oracle::inside(Point p, const std::vector<Contour>& contours) {
  int winding = 0;
  any_segment(contours, [&](Point a, Point b) {
    const long double side = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    if (a.y <= p.y && b.y > p.y && side > 0) ++winding;
    if (b.y <= p.y && a.y > p.y && side < 0) --winding;
    return false;
  });
  return winding != 0;
}

bool Oracle::cross() const {
  return any_segment(a_, [&](Point a, Point b) {
    return any_segment(b_, [&](Point p, Point q) { return segments_meet(a, b, p, q); });
  });
}

bool Oracle::nested() const {
  const auto any_inside = [](const std::vector<Contour>& inner, const std::vector<Contour>& outer) {
    return std::any_of(inner.begin(), inner.end(),
                       [&](const Contour& contour) { return inside(contour[0], outer); });
  };
  return any_inside(a_, b_) || any_inside(b_, a_);
}

long double Oracle::time_of_impact(long double x, long double y) const {
  if (cross()) return 0;
  long double first = HUGE_VALL;
  any_segment(a_, [&](Point a, Point b) {
    return any_segment(b_, [&](Point p, Point q) {
      first = std::min({first, arrival(a, x, y, p, q), arrival(p, -x, -y, a, b)});
      return false;
    });
  });
  return first;
}

long double Oracle::distance() const {
  if (cross()) return 0;
  long double smallest = HUGE_VALL;
  any_segment(a_, [&](Point a, Point b) {
    return any_segment(b_, [&](Point p, Point q) {
      smallest =
          std::min({smallest, distance(p, a, b), distance(q, a, b), distance(a, p, q), distance(b, p, q)});
      return false;
    });
  });
  return smallest;
}

}  // namespace bch::baselines
