// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <stdexcept>
#include <string>

#include <bch/body_set.hpp>
#include <bch/outline.hpp>

#include "layout/base/floating_point_state.hpp"
#include "layout/base/plane_point.hpp"
#include "layout/base/rounding.hpp"
#include "layout/base/shortest.hpp"
#include "layout/base/space_point.hpp"
#include "layout/body/body_record.hpp"
#include "layout/body/cover_rounding.hpp"

namespace bch {

using namespace detail;

namespace {

constexpr std::size_t max_pieces = 1 << 16;
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Holds a part of a prism: the corners of a convex hull about it as seen from above, and its heights.
struct Piece {
  std::vector<PlanePoint> corners;
  double bottom, top;

  PlanePoint low() const {
    PlanePoint at{infinite, infinite};
    for (const PlanePoint& corner : corners) at = lower(at, corner);
    return at;
  }
  PlanePoint high() const {
    PlanePoint at{-infinite, -infinite};
    for (const PlanePoint& corner : corners) at = upper(at, corner);
    return at;
  }
  /// Returns the radius about a centre that holds the piece.
  double radius(const SpacePoint& c) const {
    double square = 0;
    for (const PlanePoint& corner : corners)
      square = std::max(square, squared_length(corner - PlanePoint{c.x, c.y}));
    const double dz = std::max(top - c.z, c.z - bottom);
    return std::sqrt(square + dz * dz);
  }
};

/// Cuts a polygon off where a coordinate is above a limit, times a sign. What is left has the same area there, so that its corners span a hull about
/// it; lines along the cut may be gone along there and back.
std::vector<PlanePoint> cut_off(const std::vector<PlanePoint>& polygon, double PlanePoint::*axis,
                                double limit, double sign) {
  std::vector<PlanePoint> left;
  for (std::size_t i = 0, before = polygon.size() - 1; i < polygon.size(); before = i++) {
    const PlanePoint &from = polygon[before], &to = polygon[i];
    const double over_from = sign * (from.*axis - limit), over_to = sign * (to.*axis - limit);
    if ((over_from > 0) != (over_to > 0)) {
      PlanePoint between = from + over_from / (over_from - over_to) * (to - from);
      between.*axis = limit;
      left.push_back(between);
    }
    if (over_to <= 0) left.push_back(to);
  }
  return left;
}

/// Holds a prism by spheres. Pieces of it are halved until a sphere holds one and sticks out by no more than the error. Of such spheres
/// the one that is deepest inside is taken, as large as the error lets it be, so that it holds the pieces about, too; in the end it
/// shrinks to what it holds.
///
/// The ball about a point of the prism that touches the nearest side lies inside. So a sphere sticks out by no more than its radius less
/// that of this ball; the same holds of points outside, whose distance counts as a radius below 0.
class PrismCover {
 public:
  PrismCover(std::span<const Vec2> contour, const Heights& heights, double error, std::size_t most)
      : bottom_(heights.bottom), top_(heights.top), most_(most) {
    double max_extent = 0;
    for (const Vec2& corner : contour) {
      sides_.push_back(plane_point(corner));
      max_extent = std::max(max_extent, length(sides_.back()));
    }
    max_extent += std::max(std::abs(bottom_), std::abs(top_));
    spare_ = cover_rounding * (max_extent + error), error_ = error - 2 * spare_;
  }

  /// Returns spheres, or none where more would be needed than may be.
  std::vector<Sphere> run() {
    if (!(error_ > 0)) return {};
    std::deque<Piece> open = {{sides_, bottom_, top_}};
    while (!open.empty() && balls_.size() <= most_ && open.size() <= max_pieces) {
      const Piece piece = std::move(open.front());
      open.pop_front();
      if (piece.corners.empty() || is_covered(piece) || cover(piece)) continue;
      halve(piece, open);
    }
    if (!open.empty() || balls_.size() > most_) return {};
    std::vector<Sphere> spheres;
    for (const Ball& ball : balls_) {
      const auto [x, y, z] = rounded(ball.centre);
      spheres.push_back({x, y, z, static_cast<float>(ball.needed + spare_)});
    }
    return spheres;
  }

 private:
  struct Ball {
    SpacePoint centre;
    double radius, needed;  ///< what the error lets it have, and what its pieces need
  };

  bool is_inside(double x, double y) const {
    bool inside = false;
    for (std::size_t i = 0, before = sides_.size() - 1; i < sides_.size(); before = i++) {
      const PlanePoint &a = sides_[before], &b = sides_[i];
      if ((a.y > y) != (b.y > y) && x < a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
    }
    return inside;
  }

  double depth(const SpacePoint& c) const {
    const PlanePoint at{c.x, c.y};
    double square = infinite;
    for (std::size_t i = 0, before = sides_.size() - 1; i < sides_.size(); before = i++)
      square = std::min(square, squared_distance(at, sides_[before], sides_[i]));
    const double aside = std::sqrt(square), within = std::min(c.z - bottom_, top_ - c.z);
    if (is_inside(c.x, c.y)) return std::min(aside, within);
    const double beyond = std::max(0.0, -within);
    return -std::sqrt(aside * aside + beyond * beyond);
  }

  bool is_covered(const Piece& piece) {
    for (Ball& ball : balls_)
      if (const double radius = piece.radius(ball.centre); radius <= ball.radius) {
        ball.needed = std::max(ball.needed, radius);
        return true;
      }
    return false;
  }

  /// Adds a sphere that holds a piece, if there is one and it needs one.
  bool cover(const Piece& piece) {
    const PlanePoint low = piece.low(), high = piece.high();
    const auto in_float = [](const SpacePoint& at) { return space_point(rounded(at)); };
    SpacePoint best = in_float({(low.x + high.x) / 2, (low.y + high.y) / 2, (piece.bottom + piece.top) / 2});
    const double size = std::max({high.x - low.x, high.y - low.y, piece.top - piece.bottom});
    double deepest = depth(best), excess = piece.radius(best) - deepest;
    if (deepest + piece.radius(best) < -spare_) return true;  // none of the prism, but a line along cuts
    for (double step = size / 2; step > size / 32;) {
      bool is_better = false;
      for (int direction = 0; direction < 27; ++direction) {
        const SpacePoint direction_of_step{direction % 3 - 1.0, direction / 3 % 3 - 1.0,
                                           direction / 9 % 3 - 1.0};
        const SpacePoint next = in_float(best + step * direction_of_step);
        const double deep = depth(next), over = piece.radius(next) - deep;
        if (excess <= error_ ? over <= error_ && deep > deepest : over < excess)
          best = next, deepest = deep, excess = over, is_better = true;
      }
      if (!is_better) step /= 2;
    }
    if (excess > error_) return false;
    balls_.push_back({best, deepest + error_, deepest + excess});
    return true;
  }

  static void halve(const Piece& piece, std::deque<Piece>& open) {
    const PlanePoint low = piece.low(), high = piece.high();
    const double x = high.x - low.x, y = high.y - low.y, z = piece.top - piece.bottom;
    if (z >= x && z >= y) {
      const double middle = (piece.bottom + piece.top) / 2;
      open.push_back({piece.corners, piece.bottom, middle});
      open.push_back({piece.corners, middle, piece.top});
      return;
    }
    double PlanePoint::*const axis = x >= y ? &PlanePoint::x : &PlanePoint::y;
    const double middle = (low.*axis + high.*axis) / 2;
    for (const double sign : {1.0, -1.0})
      open.push_back({cut_off(piece.corners, axis, middle, sign), piece.bottom, piece.top});
  }

  std::vector<PlanePoint> sides_;
  double bottom_, top_;
  std::size_t most_;
  double spare_, error_;
  std::vector<Ball> balls_;
};

}  // namespace

std::vector<Sphere> spheres_from_polygons(std::span<const std::vector<Vec2>> polygons, const Heights& heights,
                                          float error) {
  const FloatingPointStateGuard floats;
  const Outline outline = outline_from_polygons(polygons);
  const auto refuse = [](const std::string& expected, const std::string& found) {
    throw std::invalid_argument("spheres of polygons: expected " + expected + ", found " + found);
  };
  constexpr auto farthest = static_cast<float>(rounding::largest_extent);
  if (!(heights.bottom < heights.top && heights.bottom >= -farthest && heights.top <= farthest))
    refuse("a bottom below the top, within +-1e6 m",
           shortest(heights.bottom) + " and " + shortest(heights.top));
  if (!(error > 0 && error <= farthest)) refuse("an error above 0, up to 1e6 m", shortest(error));
  std::vector<Sphere> spheres;
  for (std::size_t i = 0; i < outline.contours(); ++i) {
    const std::vector<Sphere> part =
        PrismCover(outline.contour(i), heights, double{error}, max_spheres - spheres.size()).run();
    if (part.empty())
      refuse("an error that " + std::to_string(max_spheres) + " spheres keep",
             shortest(error) + " m at polygon " + std::to_string(i));
    spheres.insert(spheres.end(), part.begin(), part.end());
  }
  return spheres;
}

}  // namespace bch
