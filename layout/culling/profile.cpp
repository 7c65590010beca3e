// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/culling/profile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "layout/base/plane_point.hpp"
#include "layout/base/rounding.hpp"
#include "layout/culling/contour_lanes.hpp"
#include "layout/culling/cut_lanes.hpp"
#include "layout/format/contours.hpp"

/// Rounding, with the notation of rounding.hpp. A query computes the line of length D between the centres, and the
/// sectors of both profiles along it, in float. Three errors follow:
///
///     (along)    40 u S     of the line
///     (across)   40 u P     of either shape: the rotation of B, the direction of the line as seen from B, and the
///                           sector are off by another 20 u; a point is at most 2 P from the profile's centre
///     (sums)     6 u S      of the sums of two bounds, and their comparison with D
///
/// inner: A disc of radius `margin` about each point of the sector, up to `inner`, touches no contour. If inner_A +
/// inner_B >= D, a point between the centres belongs to both areas. It still belongs to both if B is moved by (along),
/// and if the point lies (across) beside the exact line.
///
/// outer: The same three errors count, and the 23 u S by which discs may be apart that the float test accepts. The sum
/// 23 + 40 + 40 + 6 is below 110 u S. Outer bounds are enlarged by 320 u P, as supports are. For segments that meet,
/// (segment_price) replaces the 23 u S; it is less than 29 u S.
///
/// extent: The same three errors count. What the enlargement of outer exceeds 110 u S by is enough for them.
///
/// Tests fail if the sign of `margin` is wrong. Only this proof needs all of it.
namespace bch::detail {
namespace {

using Polygon = std::span<const Vec2>;
static_assert(profile_sectors == support_directions, "the lanes of CutLanes::heights()");

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr double margin = 128 * rounding::unit_roundoff;
constexpr double along = 40, across = 40, sums = 6;  // in units of u
static_assert(margin >= (along + across + sums) * rounding::unit_roundoff);
static_assert(rounding::support_margin >=
              (rounding::terms::query_error + along + across + sums) * rounding::unit_roundoff);
static_assert(rounding::support_margin >=
              rounding::segment_price + (along + across + sums) * rounding::unit_roundoff);

constexpr std::uint32_t quadrant = profile_sectors / 4;

/// Unit vectors between sectors: the one before sector k, and after the last one the first again.
struct Boundaries {
  std::array<PlanePoint, profile_sectors + 1> at;
  std::array<double, profile_sectors + 1> x, y;
  std::array<float, quadrant> cosine, sine;  ///< of the first quadrant
  /// The cosine of the angle of sector k, and one over the square of its sine.
  std::array<double, profile_sectors> gap_cosine, over_square_sine;

  Boundaries() {
    for (std::uint32_t k = 0; k <= profile_sectors; ++k) {
      const double b = k % quadrant, a = quadrant - b, length = std::sqrt(a * a + b * b);
      const PlanePoint turned[] = {{a, b}, {-b, a}, {-a, -b}, {b, -a}};
      const PlanePoint& p = turned[k / quadrant % 4];
      at[k] = {p.x / length, p.y / length};
      x[k] = at[k].x, y[k] = at[k].y;
    }
    for (std::uint32_t k = 0; k < quadrant; ++k)
      cosine[k] = static_cast<float>(at[k].x), sine[k] = static_cast<float>(at[k].y);
    for (std::uint32_t k = 0; k < profile_sectors; ++k) {
      gap_cosine[k] = dot(at[k], at[k + 1]);
      over_square_sine[k] = 1 / (1 - gap_cosine[k] * gap_cosine[k]);
    }
  }
};

const Boundaries& boundaries() {
  static const Boundaries all;
  return all;
}

/// Returns the centroid of the contour's area, or its first point where it has no area.
PlanePoint centroid(Polygon contour) {
  const PlanePoint origin = plane_point(contour[0]);
  double area = 0, x = 0, y = 0;
  for (std::size_t i = 2; i < contour.size(); ++i) {
    const PlanePoint a = plane_point(contour[i - 1]) - origin, b = plane_point(contour[i]) - origin;
    area += cross(a, b), x += cross(a, b) * (a.x + b.x), y += cross(a, b) * (a.y + b.y);
  }
  if (!(area > 0)) return origin;
  return {origin.x + x / (3 * area), origin.y + y / (3 * area)};
}

/// What of a segment lies on the side of a line where a linear function, given at either end, is positive.
struct Clip {
  double from = 0, to = 1;

  void keep_positive(double at_a, double at_b) {
    if (at_a < 0 && at_b < 0) to = -1;
    if (at_a < 0 && at_b >= 0) from = std::max(from, at_a / (at_a - at_b));
    if (at_b < 0 && at_a >= 0) to = std::min(to, at_a / (at_a - at_b));
  }
};

/// A segment, seen from the origin.
struct Segment {
  PlanePoint a, b;
  double foot;  ///< where its line comes nearest: the parameter t from a to b

  /// Square of the distance of what lies between two boundaries, each moved out by `wider`.
  double square_distance_in(PlanePoint right, PlanePoint left, double wider) const {
    Clip clip;
    clip.keep_positive(cross(right, a) + wider, cross(right, b) + wider);
    clip.keep_positive(cross(a, left) + wider, cross(b, left) + wider);
    if (clip.from > clip.to) return infinity;
    const double t = std::clamp(foot, clip.from, clip.to);
    const PlanePoint there{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
    return dot(there, there);
  }
};

/// How far the contour's inside goes on from the centre, sector by sector.
class Inside {
 public:
  Inside(Polygon contour, PlanePoint centre, double max_extent)
      : to_(boundaries()), wider_(margin * max_extent) {
    square_.fill(infinity);
    bool inside = false;
    Vec2 begin = contour.back();
    for (std::size_t i = 0; i < contour.size(); i += Segments::most) {
      const Polygon ends = contour.subspan(i, std::min(Segments::most, contour.size() - i));
      const Segments segments(begin, ends, centre.x, centre.y);
      for (std::size_t k = 0; k < segments.size(); ++k) {
        inside ^= segments.crosses(k);
        limit(segments, k);
      }
      begin = ends.back();
    }
    // A contour so near would be wide of the neighbours of its sectors.
    const double nearest = *std::min_element(square_.begin(), square_.end());
    if (!inside || nearest < 64 * wider_ * 64 * wider_) square_.fill(0);
  }

  float inner(std::uint32_t k) const {
    const double rounded_in = std::sqrt(square_[k]) - 2 * wider_;
    return rounded_in > 0 ? static_cast<float>(rounded_in) : -infinity;
  }

 private:
  using Segments = ContourLanes<BaseLanes>;

  /// Limits the inner distances by a segment, in the sectors that it crosses, counter-clockwise, and their
  /// neighbours. Most segments lie in one sector, and not in a neighbour made wider. In most of several
  /// sectors another segment is nearer, whatever part of this one lies there.
  void limit(const Segments& segments, std::size_t i) {
    const std::uint32_t begin = segments.sector(i), end = segments.sector(i + 1);
    const double least = segments.square_distance(i);
    if (begin == end && std::min(segments.aside(i), segments.aside(i + 1)) > wider_) {
      square_[begin] = std::min(square_[begin], least);
      return;
    }
    const Segment segment{
        {segments.x(i), segments.y(i)}, {segments.x(i + 1), segments.y(i + 1)}, segments.foot(i)};
    const bool left = segments.turns_left(i);
    const std::uint32_t first = left ? begin : end, stop = ((left ? end : begin) + 2) % profile_sectors;
    for (std::uint32_t k = (first + profile_sectors - 1) % profile_sectors; k != stop;
         k = (k + 1) % profile_sectors)
      if (least < square_[k])
        square_[k] = std::min(square_[k], segment.square_distance_in(to_.at[k], to_.at[k + 1], wider_));
  }

  const Boundaries& to_;
  double wider_;
  std::array<double, profile_sectors> square_;  ///< of distances
};

/// Returns, for each sector, a lower bound of how far the contour extends in the directions opposite to the sector's.
/// Each of a few farthest points of the contour gives a bound: the lesser of its extents along the two directions that
/// limit the sector. In between its extent is no less, if the lesser one is positive.
std::array<double, profile_sectors> extents(const Interior& interior, PlanePoint centre) {
  const Boundaries& to = boundaries();
  std::array<double, profile_sectors> most{};
  for (std::uint32_t i = 0; i < extreme_directions; ++i) {
    const PlanePoint p = plane_point({interior.extreme_x[i], interior.extreme_y[i]}) - centre;
    std::array<double, profile_sectors + 1> behind;
    for (std::uint32_t k = 0; k <= profile_sectors; ++k) behind[k] = -(p.x * to.x[k] + p.y * to.y[k]);
    for (std::uint32_t k = 0; k < profile_sectors; ++k) {
      const double both = behind[k] < behind[k + 1] ? behind[k] : behind[k + 1];
      most[k] = most[k] < both ? both : most[k];
    }
  }
  return most;
}

}  // namespace

Profile profile(const Outline& outline, const Interior& interior, double max_extent) {
  Profile result{};
  for (Sector& each : result.sectors) each = {-infinity, infinity, -infinity, infinity};
  if (outline.contours() == 0) return result;
  const Polygon contour = largest_contour(outline);
  const PlanePoint exact = centroid(contour);
  result.x = static_cast<float>(exact.x), result.y = static_cast<float>(exact.y);
  const PlanePoint centre = plane_point({result.x, result.y});
  const Inside inside(contour, centre, max_extent);
  for (std::uint32_t k = 0; k < profile_sectors; ++k) result.sectors[k].inner = inside.inner(k);
  if (outline.contours() > 1) return result;
  const auto behind = extents(interior, centre);
  for (std::uint32_t k = 0; k < profile_sectors; ++k)
    if (behind[k] > 0) result.sectors[k].extent = static_cast<float>(behind[k] - margin * max_extent);
  return result;
}

Outer outer(const Profile& profile, const float* x, const float* y, const float* radius, std::uint32_t count,
            double max_extent) {
  const Boundaries& to = boundaries();
  std::array<float, profile_sectors> heights;
  CutLanes<BaseLanes>::heights({x, y, radius, count}, to.cosine.data(), to.sine.data(), heights.data());
  const auto centre_x = static_cast<double>(profile.x), centre_y = static_cast<double>(profile.y);
  std::array<double, profile_sectors + 1> height;
  for (std::uint32_t k = 0; k < profile_sectors; ++k)
    height[k] = static_cast<double>(heights[k]) - (centre_x * to.x[k] + centre_y * to.y[k]);
  height[profile_sectors] = height[0];
  // The farthest point is the corner of the supporting lines of either end, if that is in the sector. No
  // branch.
  Outer result;
  for (std::uint32_t k = 0; k < profile_sectors; ++k) {
    const double right = height[k], left = height[k + 1], cosine = to.gap_cosine[k];
    const double corner =
        std::sqrt((right * right + left * left - 2 * right * left * cosine) * to.over_square_sine[k]);
    const double larger = right < left ? left : right, smaller = right < left ? right : left;
    const double farthest = smaller < larger * cosine ? larger : corner;
    result[k] = static_cast<float>(farthest + rounding::support_margin * max_extent);
  }
  return result;
}

Bounds outline_bounds(const Profile& profile, const PointDiscs& points, double max_extent) {
  const float *const x = points.x.data(), *const y = points.y.data(), *const radius = points.radius.data();
  return {supports(x, y, radius, points.count(), max_extent),
          outer(profile, x, y, radius, points.count(), max_extent)};
}

/// Between two directions, a bound is given by the corner of two supporting lines. If both lines are farther by d,
/// their corner is farther by d over the cosine of half the angle between them, which is at most 1.0048 d. Outer
/// bounds have no corners, so they are compared without this factor.
float excess(const Bounds& discs, const Bounds& smaller) {
  constexpr double of_corner = 1.005;
  static_assert(support_directions == 32);
  double most = 0;
  for (std::uint32_t k = 0; k < support_stride; ++k)
    most = std::max(most, of_corner * (static_cast<double>(discs.supports[k]) -
                                       static_cast<double>(smaller.supports[k])));
  for (std::uint32_t k = 0; k < profile_sectors; ++k)
    most = std::max(most, static_cast<double>(discs.outer[k]) - static_cast<double>(smaller.outer[k]));
  return rounding::round_up(most);
}

}  // namespace bch::detail
