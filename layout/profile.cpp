// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/profile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "layout/cut_lanes.hpp"
#include "layout/rounding.hpp"

/// Rounding, in the terms of rounding.hpp. The line of centres D that a query computes in float is within 40 u S of the
/// exact one; B's turn, D seen from B, and the sector are off by another 20 u, which is 40 u P_A and 40 u P_B across.
///
/// inner: a disc of `margin` about each point of the sector, out to there, touches no contour. So the point that both
/// have still belongs to both when B is moved by 40 u S and lies 40 u P beside its line. Sums and comparison: 6 u S.
/// outer: the same error along and across the line, and the 23 u S by which discs that the test accepts may be apart:
/// 23 + 40 + 40 + 6 < 110 u S, where supports are enlarged by 320 u P.
/// extent: the same without the 23 u S, on top of what outer has to spare.
namespace bch {
namespace {

using Polygon = std::span<const Vec2>;
static_assert(profile_sectors == support_directions, "the lanes of CutLanes::heights()");

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr double margin = 128 * rounding::unit_roundoff;

struct Point {
  double x, y;
};

double cross(Point a, Point b) {
  return a.x * b.y - a.y * b.x;
}
double dot(Point a, Point b) {
  return a.x * b.x + a.y * b.y;
}
Point minus(Vec2 p, Point q) {
  return {static_cast<double>(p.x) - q.x, static_cast<double>(p.y) - q.y};
}

/// Unit vectors between sectors: the one before sector k, and after the last one the first again.
struct Boundaries {
  std::array<Point, profile_sectors + 1> at;
  std::array<float, profile_sectors> cosine, sine;

  Boundaries() {
    constexpr std::uint32_t quadrant = profile_sectors / 4;
    for (std::uint32_t k = 0; k < profile_sectors; ++k) {
      const double y = k % quadrant, x = quadrant - y, length = std::sqrt(x * x + y * y);
      const Point turned[] = {{x, y}, {-y, x}, {-x, -y}, {y, -x}};
      const Point& p = turned[k / quadrant];
      at[k] = {p.x / length, p.y / length};
      cosine[k] = static_cast<float>(at[k].x), sine[k] = static_cast<float>(at[k].y);
    }
    at[profile_sectors] = at[0];
  }
};

const Boundaries& boundaries() {
  static const Boundaries all;
  return all;
}

std::uint32_t sector(Point p) {
  constexpr std::uint32_t quadrant = profile_sectors / 4;
  const double sum = std::abs(p.x) + std::abs(p.y), share = sum > 0 ? quadrant * std::abs(p.y) / sum : 0;
  const double half = p.x < 0 ? 2 * quadrant - share : share;
  return static_cast<std::uint32_t>(p.y < 0 ? 4 * quadrant - half : half) % profile_sectors;
}

/// Of the contour's area; its first point where it has none.
Point centroid(Polygon contour) {
  const Point origin = minus(contour[0], {0, 0});
  double area = 0, x = 0, y = 0;
  for (std::size_t i = 2; i < contour.size(); ++i) {
    const Point a = minus(contour[i - 1], origin), b = minus(contour[i], origin);
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

/// A segment, seen from the origin, and where its line comes nearest.
struct Segment {
  Point a, b, along;
  double foot;

  Segment(Point from, Point to) : a(from), b(to), along{to.x - from.x, to.y - from.y} {
    const double square = dot(along, along);
    foot = square > 0 ? -dot(a, along) / square : 0;
  }

  /// Square of the origin's distance to what lies in a sector made wider by `wider` on either side.
  double square_distance_in(std::uint32_t k, double wider) const {
    const Point right = boundaries().at[k], left = boundaries().at[k + 1];
    Clip clip;
    clip.keep_positive(cross(right, a) + wider, cross(right, b) + wider);
    clip.keep_positive(cross(a, left) + wider, cross(b, left) + wider);
    if (clip.from > clip.to) return infinity;
    const double s = std::clamp(foot, clip.from, clip.to);
    const Point nearest{a.x + s * along.x, a.y + s * along.y};
    return dot(nearest, nearest);
  }
};

/// How far the contour's inside goes on from the centre, sector by sector.
class Inside {
 public:
  Inside(Polygon contour, Point centre, double reach) : wider_(margin * reach) {
    square_.fill(infinity);
    bool inside = false;
    Point a = minus(contour.back(), centre);
    std::uint32_t sector_a = sector(a);
    for (const Vec2 point : contour) {
      const Point b = minus(point, centre);
      const std::uint32_t sector_b = sector(b);
      const bool left = cross(a, b) >= 0;
      inside ^= (a.y > 0) != (b.y > 0) && left == (b.y > a.y);
      limit({a, b}, left ? sector_a : sector_b, left ? sector_b : sector_a);
      a = b, sector_a = sector_b;
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
  /// By a segment, in the sectors that it crosses, counter-clockwise, and their neighbours.
  void limit(const Segment& segment, std::uint32_t first, std::uint32_t last) {
    const std::uint32_t end = (last + 2) % profile_sectors;
    for (std::uint32_t k = (first + profile_sectors - 1) % profile_sectors; k != end;
         k = (k + 1) % profile_sectors)
      square_[k] = std::min(square_[k], segment.square_distance_in(k, wider_));
  }

  double wider_;
  std::array<double, profile_sectors> square_;  ///< of distances
};

/// The least that the contour extends to in a direction opposite to a sector: its farthest points do at either end, and
/// what is positive there is no less between.
float extent(const Interior& interior, Point centre, std::uint32_t k, double reach) {
  double most = 0;
  for (std::uint32_t i = 0; i < extreme_directions; ++i) {
    const Point p = minus({interior.extreme_x[i], interior.extreme_y[i]}, centre);
    most = std::max(most, -std::max(dot(p, boundaries().at[k]), dot(p, boundaries().at[k + 1])));
  }
  return most > 0 ? static_cast<float>(most - margin * reach) : -infinity;
}

/// The farthest that anything extends to in a sector: to the corner of the supporting lines of either end, where the
/// corner is in the sector.
double farthest(std::uint32_t k, double right, double left) {
  const double cosine = dot(boundaries().at[k], boundaries().at[k + 1]);
  if (right < left * cosine || left < right * cosine) return std::max(right, left);
  return std::sqrt((right * right + left * left - 2 * right * left * cosine) / (1 - cosine * cosine));
}

}  // namespace

Profile profile(const Outline& outline, const Interior& interior, double reach) {
  Profile result{};
  for (Sector& each : result.sectors) each = {-infinity, infinity, -infinity, infinity};
  if (outline.contours() == 0) return result;
  const Polygon contour = largest_contour(outline);
  const Point exact = centroid(contour);
  result.x = static_cast<float>(exact.x), result.y = static_cast<float>(exact.y);
  const Point centre = minus({result.x, result.y}, {0, 0});
  const Inside inside(contour, centre, reach);
  for (std::uint32_t k = 0; k < profile_sectors; ++k) {
    result.sectors[k].inner = inside.inner(k);
    if (outline.contours() == 1) result.sectors[k].extent = extent(interior, centre, k, reach);
  }
  return result;
}

Outer outer(const Profile& profile, const float* x, const float* y, const float* radius, std::uint32_t count,
            double reach) {
  std::array<float, profile_sectors> heights;
  CutLanes<xsimd::sse2>::heights({x, y, radius, count}, boundaries().cosine.data(), boundaries().sine.data(),
                                 heights.data());
  const Point centre{profile.x, profile.y};
  const auto height = [&](std::uint32_t k) {
    return static_cast<double>(heights[k % profile_sectors]) - dot(centre, boundaries().at[k]);
  };
  Outer result;
  for (std::uint32_t k = 0; k < profile_sectors; ++k)
    result[k] = static_cast<float>(farthest(k, height(k), height(k + 1)) + rounding::support_margin * reach);
  return result;
}

}  // namespace bch
