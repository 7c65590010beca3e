// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/nested_contours.hpp"

#include <algorithm>
#include <cmath>

#include "layout/enclosing_disc/enclosing_disc.hpp"

namespace bch::baselines {
namespace {

/// A placement in float is off by less than this times the lengths of what it places (layout/base/rounding.hpp, II).
constexpr double placement_error = 1e-5;

/// Takes a point of the first agent into the frame of the second one.
Point2 back(const Placement& place, Point2 p) noexcept {
  const double x = p.x - place.x, y = p.y - place.y;
  return {place.cosine * x + place.sine * y, place.cosine * y - place.sine * x};
}

}  // namespace

void NestedContours::add(const Outline& outline) {
  for (std::size_t i = 0; i < outline.contours(); ++i) {
    const auto points = outline.contour(i);
    const auto [centre, radius] = detail::smallest_enclosing_disc(points);
    const auto begin = static_cast<std::uint32_t>(points_.size());
    points_.insert(points_.end(), points.begin(), points.end());
    const Point2 at = exact(centre);
    contours_.push_back({at, radius, placement_error * (std::abs(at.x) + std::abs(at.y) + radius), begin,
                         static_cast<std::uint32_t>(points_.size())});
  }
  begin_.push_back(static_cast<std::uint32_t>(contours_.size()));
}

std::span<const NestedContours::Contour> NestedContours::contours_of(std::uint32_t shape) const noexcept {
  return std::span(contours_).subspan(begin_[shape], begin_[shape + 1] - begin_[shape]);
}

/// The points that determine the disc of a contour inside are in no half of it, so that one of them is at least
/// sqrt(d^2 + r^2) away from the centre of the other disc, which holds it.
bool NestedContours::one_may_be_inside(const Contour& a, const Contour& b, Point2 b_centre) noexcept {
  const double x = b_centre.x - a.centre.x, y = b_centre.y - a.centre.y;
  const double less = std::min(a.radius, b.radius),
               limit = std::max(a.radius, b.radius) + (a.slack + b.slack);
  return x * x + y * y + less * less <= limit * limit;
}

/// By the parity of the edges to the point's right.
bool NestedContours::contains(const Contour& outer, Point2 point) const noexcept {
  bool odd = false;
  Point2 from = exact(points_[outer.end - 1]);
  for (std::uint32_t i = outer.begin; i < outer.end; ++i) {
    const Point2 to = exact(points_[i]);
    if ((from.y > point.y) != (to.y > point.y)) {
      const double side = (to.x - from.x) * (point.y - from.y) - (to.y - from.y) * (point.x - from.x);
      odd ^= (to.y > from.y) == (side > 0);
    }
    from = to;
  }
  return odd;
}

bool NestedContours::query(const Agents& agents, Pair pair, const FloatPlacement& place) const noexcept {
  const auto [first, second] = std::minmax(pair.first, pair.second);
  const Placement rough{place.cosine, place.sine, place.x, place.y};
  for (const Contour& b : contours_of(agents.shape[second])) {
    const Point2 centre = rough.place(b.centre.x, b.centre.y);
    for (const Contour& a : contours_of(agents.shape[first])) {
      if (!one_may_be_inside(a, b, centre)) continue;
      const Placement exactly = placement(agents, pair);
      if (a.radius > b.radius ? contains(a, exactly.place(points_[b.begin]))
                              : contains(b, back(exactly, exact(points_[a.begin]))))
        return true;
    }
  }
  return false;
}

}  // namespace bch::baselines
