// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/base/disc_union_area.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
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
  // If two discs are equal, the first one counts.
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

/// An arc that no disc hides bounds what is covered.
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

/// Circles in square cells, each as wide as the largest circle: which ones may meet another lie in the nine cells about it.
class CircleGrid {
 public:
  explicit CircleGrid(const std::vector<Circle>& circles) {
    double largest = 0, extent = 0;
    for (const Circle& c : circles) {
      left_ = std::min(left_, c.x), low_ = std::min(low_, c.y);
      largest = std::max(largest, c.radius);
    }
    for (const Circle& c : circles) extent = std::max({extent, c.x - left_, c.y - low_});
    // Wider by far more than what is rounded, and no more than millions of cells in a row.
    side_ = std::max({2 * largest * (1 + 1e-6), 1e-6 * extent, 1e-9});
    for (std::size_t i = 0; i < circles.size(); ++i) cells_.push_back({cell_of(circles[i]), i});
    std::ranges::sort(cells_);
  }

  /// Calls each(i) for those that may meet the circle, until it returns false.
  template <class Each>
  void visit(const Circle& circle, Each each) const {
    const std::uint64_t cell = cell_of(circle);
    for (const std::uint64_t row : {cell - one_up, cell, cell + one_up})
      for (auto at = std::ranges::lower_bound(cells_, row - 1, {}, &Entry::first);
           at != cells_.end() && at->first <= row + 1; ++at)
        if (!each(at->second)) return;
  }

 private:
  using Entry = std::pair<std::uint64_t, std::size_t>;  ///< a cell, and a circle in it
  static constexpr std::uint64_t one_up = std::uint64_t{1} << 32;

  /// A number of its row, and behind it one of its column, both from 1 on.
  std::uint64_t cell_of(const Circle& c) const {
    const auto place = [this](double from) { return static_cast<std::uint64_t>(from / side_) + 1; };
    return place(c.y - low_) * one_up + place(c.x - left_);
  }

  double left_ = HUGE_VAL, low_ = HUGE_VAL, side_ = 1;
  std::vector<Entry> cells_;
};

}  // namespace

double union_area(std::span<const Disc> discs) {
  std::vector<Circle> circles;
  for (const Disc& d : discs)
    circles.push_back({static_cast<double>(d.x), static_cast<double>(d.y), static_cast<double>(d.radius)});
  const CircleGrid grid(circles);
  double area = 0;
  std::vector<Arc> hidden;
  for (std::size_t i = 0; i < circles.size(); ++i) {
    hidden.clear();
    bool visible = true;
    grid.visit(circles[i], [&](std::size_t j) {
      return visible = j == i || add_hidden_arcs(circles[i], circles[j], i < j, hidden);
    });
    if (visible) area += visible_area(circles[i], hidden);
  }
  return area;
}

std::vector<Disc> discs_of(const Hierarchy& hierarchy, std::uint32_t depth) {
  std::vector<Disc> discs;
  for (const std::uint32_t node : cut(hierarchy, depth)) discs.push_back(hierarchy.nodes[node].disc);
  return discs;
}

}  // namespace bch::cli
