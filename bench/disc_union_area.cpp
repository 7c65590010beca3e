// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/disc_union_area.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

namespace bch::cli {
namespace {

constexpr double turn = 2 * std::numbers::pi;

struct Circle {
  double x, y, radius;
};

/// Angles of a circle, begin <= end, within [0, turn].
using Arc = std::pair<double, double>;

/// Half the integral of x dy - y dx along an arc.
double swept_area(const Circle& c, double begin, double end) {
  const double x = std::sin(end) - std::sin(begin), y = std::cos(end) - std::cos(begin);
  return c.radius / 2 * (c.radius * (end - begin) + c.x * x - c.y * y);
}

/// Adds the arcs of circle a that lie in disc b. Returns: false where that is all of a.
bool add_hidden_arcs(const Circle& a, const Circle& b, bool a_first, std::vector<Arc>& hidden) {
  const double x = b.x - a.x, y = b.y - a.y, distance = std::hypot(x, y);
  if (distance >= a.radius + b.radius) return true;
  // Of two equal discs the first one counts.
  if (distance == 0 && a.radius == b.radius) return a_first;
  if (distance + a.radius <= b.radius) return false;
  if (distance + b.radius <= a.radius) return true;
  const double cosine =
      (a.radius * a.radius - b.radius * b.radius + distance * distance) / (2 * a.radius * distance);
  const double half = std::acos(std::clamp(cosine, -1.0, 1.0));
  double begin = std::atan2(y, x) - half;
  if (begin < 0) begin += turn;
  const double end = begin + 2 * half;
  hidden.push_back({begin, std::min(end, turn)});
  if (end > turn) hidden.push_back({0, end - turn});
  return true;
}

double visible_area(const Circle& circle, std::vector<Arc>& hidden) {
  std::sort(hidden.begin(), hidden.end());
  hidden.push_back({turn, turn});
  double sum = 0, seen_to = 0;
  for (const auto& [begin, end] : hidden) {
    if (begin > seen_to) sum += swept_area(circle, seen_to, begin);
    seen_to = std::max(seen_to, end);
  }
  return sum;
}

}  // namespace

double union_area(std::span<const Disc> discs) {
  std::vector<Circle> circles;
  for (const Disc& d : discs)
    circles.push_back({static_cast<double>(d.x), static_cast<double>(d.y), static_cast<double>(d.radius)});
  double area = 0;
  std::vector<Arc> hidden;
  for (std::size_t i = 0; i < circles.size(); ++i) {
    hidden.clear();
    bool visible = true;
    for (std::size_t j = 0; j < circles.size() && visible; ++j)
      if (j != i) visible = add_hidden_arcs(circles[i], circles[j], i < j, hidden);
    if (visible) area += visible_area(circles[i], hidden);
  }
  return area;
}

}  // namespace bch::cli
