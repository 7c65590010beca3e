// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/animation/contour.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

namespace bch::detail {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Calls visit(from, to) for each segment.
template <class Visit>
void for_each_segment(std::span<const Vec2> contour, Visit visit) {
  for (std::size_t i = 0; i < contour.size(); ++i)
    visit(plane_point(contour[i]), plane_point(contour[i + 1 < contour.size() ? i + 1 : 0]));
}

double length_of(std::span<const Vec2> contour) {
  double whole = 0;
  for_each_segment(contour,
                   [&](const PlanePoint& from, const PlanePoint& to) { whole += length(to - from); });
  return whole;
}

void set_directions(EvenContour& way) {
  constexpr std::size_t reach = 2;
  const std::size_t count = way.points.size();
  const double straight = 2 * static_cast<double>(reach) * way.step;
  way.inward.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const PlanePoint along = way.points[(i + reach) % count] - way.points[(i + count - reach) % count];
    way.inward.push_back({-along.y / straight, along.x / straight});
  }
}

/// The table of dynamic time warping: both rows and columns begin at the pair that fits best, and end there, once round.
class Warping {
 public:
  Warping(std::span<const ExpectedPoint> points, const EvenContour& way, double turn_cost)
      : points_(points), way_(way), turn_square_(turn_cost * turn_cost) {
    double best = infinity;
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t j = 0; j < way.points.size(); ++j)
        if (const double c = cost_of(i, j); c < best) {
          best = c;
          first_ = i;
          start_ = j;
        }
  }

  void fill();
  std::vector<std::size_t> places() const;

 private:
  /// Where the cheapest way to a pair comes from: the pair before in both, or in one.
  enum class From : std::uint8_t { both, points, way };

  double cost_of(std::size_t i, std::size_t j) const {
    return squared_length(points_[i].position - way_.points[j]) +
           turn_square_ * squared_length(points_[i].inward - way_.inward[j]);
  }
  double cost(std::size_t row, std::size_t column) const {
    return cost_of((first_ + row) % points_.size(), (start_ + column) % way_.points.size());
  }
  std::size_t columns() const { return way_.points.size() + 1; }

  std::span<const ExpectedPoint> points_;
  const EvenContour& way_;
  double turn_square_;
  std::size_t first_ = 0, start_ = 0;
  std::vector<From> from_;
};

void Warping::fill() {
  std::vector<double> row(columns()), above(columns());
  from_.resize((points_.size() + 1) * columns());
  for (std::size_t i = 0; i <= points_.size(); ++i) {
    std::swap(row, above);
    for (std::size_t j = 0; j < columns(); ++j) {
      double least = i + j == 0 ? 0 : infinity;
      From& from = from_[i * columns() + j];
      const auto take = [&](double sum, From where) {
        if (sum >= least) return;
        least = sum;
        from = where;
      };
      if (i > 0 && j > 0) take(above[j - 1], From::both);
      if (i > 0) take(above[j], From::points);
      if (j > 0) take(row[j - 1], From::way);
      row[j] = least + cost(i, j);
    }
  }
}

/// Returns, of the places that each point got, the one that fits best.
std::vector<std::size_t> Warping::places() const {
  const std::size_t count = points_.size(), size = way_.points.size();
  std::vector<std::size_t> found(count);
  std::vector<double> least(count, infinity);
  for (std::size_t i = count, j = size; i + j > 0;) {
    const From from = from_[i * columns() + j];
    if (from != From::way) --i;
    if (from != From::points) --j;
    if (i == count || cost(i, j) >= least[i]) continue;
    least[i] = cost(i, j);
    found[i] = j;
  }
  found[0] = 0;
  std::vector<std::size_t> result(count);
  for (std::size_t i = 0; i < count; ++i)
    result[i] = start_ + found[(i + count - first_) % count] + (i >= first_ ? size : 0);
  const std::size_t rounds = result[0] / size * size;
  for (std::size_t& place : result) place -= rounds;
  return result;
}

}  // namespace

std::span<const Vec2> longest_contour(const Outline& outline) {
  std::size_t longest = 0;
  for (std::size_t c = 1; c < outline.contours(); ++c)
    if (length_of(outline.contour(c)) > length_of(outline.contour(longest))) longest = c;
  return outline.contour(longest);
}

EvenContour follow(std::span<const Vec2> contour, double step) {
  constexpr double most_points = 0x1p16;
  const double whole = length_of(contour), wanted = std::max(8.0, std::ceil(whole / step));
  if (wanted > most_points) throw std::length_error("animated discs: an outline is too long for the spacing");
  const auto count = static_cast<std::size_t>(wanted);
  EvenContour way;
  way.step = whole / wanted;
  double gone = 0;
  for_each_segment(contour, [&](const PlanePoint& from, const PlanePoint& to) {
    const auto next = [&] { return static_cast<double>(way.points.size()) * way.step; };
    const double size = length(to - from);
    while (way.points.size() < count && next() < gone + size)
      way.points.push_back(from + ((next() - gone) / size) * (to - from));
    gone += size;
  });
  way.points.resize(count, plane_point(contour[0]));
  set_directions(way);
  return way;
}

std::vector<std::uint32_t> vertices_on(const Outline& outline, std::span<const Vec2> vertices) {
  const auto less = [](const Vec2& a, const Vec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
  const auto snapped = [step = outline.grid_step](float x) { return std::round(x / step) * step; };
  std::vector<Vec2> points = outline.points;
  std::sort(points.begin(), points.end(), less);
  std::vector<std::uint32_t> found;
  for (std::uint32_t v = 0; v < vertices.size(); ++v)
    if (std::binary_search(points.begin(), points.end(), Vec2{snapped(vertices[v].x), snapped(vertices[v].y)},
                           less))
      found.push_back(v);
  return found;
}

double depth_in(std::span<const Vec2> contour, const PlanePoint& p) {
  double nearest = infinity;
  bool inside = false;
  for_each_segment(contour, [&](const PlanePoint& a, const PlanePoint& b) {
    nearest = std::min(nearest, squared_distance(p, a, b));
    if ((a.y > p.y) != (b.y > p.y)) inside ^= p.x - a.x < (b.x - a.x) * ((p.y - a.y) / (b.y - a.y));
  });
  return inside ? std::sqrt(nearest) : -std::sqrt(nearest);
}

double depth_in(const Outline& outline, const PlanePoint& p) {
  double deepest = -infinity;
  for (std::size_t c = 0; c < outline.contours(); ++c)
    deepest = std::max(deepest, depth_in(outline.contour(c), p));
  return deepest;
}

std::vector<std::size_t> match_in_order(std::span<const ExpectedPoint> points, const EvenContour& way,
                                        double turn_cost) {
  Warping warping(points, way, turn_cost);
  warping.fill();
  return warping.places();
}

}  // namespace bch::detail
