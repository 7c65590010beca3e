// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/report/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace bch::report {
namespace {

/// Pixels first <= i < last of a row.
using PixelRun = std::pair<std::int64_t, std::int64_t>;

/// The pixels whose centres are in [low, high].
PixelRun pixels_between(double low, double high) {
  return {static_cast<std::int64_t>(std::ceil(low / pixel - 0.5)),
          static_cast<std::int64_t>(std::floor(high / pixel - 0.5)) + 1};
}

void add_discs(std::span<const Disc> discs, double y, std::vector<PixelRun>& runs) {
  for (const Disc& disc : discs) {
    const double away = static_cast<double>(disc.y) - y, r = static_cast<double>(disc.radius);
    const double square = r * r - away * away;
    if (square < 0) continue;
    const double half = std::sqrt(square), x = static_cast<double>(disc.x);
    runs.push_back(pixels_between(x - half, x + half));
  }
}

/// Between every other crossing: contours neither nest nor cross.
void add_crossings(const Outline& outline, double y, std::vector<double>& crossings,
                   std::vector<PixelRun>& runs) {
  crossings.clear();
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    const auto points = outline.contour(c);
    for (std::size_t i = 0, before = points.size() - 1; i < points.size(); before = i++) {
      const double ay = static_cast<double>(points[before].y), by = static_cast<double>(points[i].y);
      if ((ay > y) == (by > y)) continue;
      const double ax = static_cast<double>(points[before].x), bx = static_cast<double>(points[i].x);
      crossings.push_back(ax + (y - ay) / (by - ay) * (bx - ax));
    }
  }
  std::sort(crossings.begin(), crossings.end());
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
    runs.push_back(pixels_between(crossings[i], crossings[i + 1]));
}

/// Pixels in some run; sorts them.
std::int64_t count(std::vector<PixelRun>& runs) {
  std::sort(runs.begin(), runs.end());
  std::int64_t sum = 0, seen_to = std::numeric_limits<std::int64_t>::min();
  for (const auto& [first, last] : runs) {
    sum += std::max<std::int64_t>(0, last - std::max(first, seen_to));
    seen_to = std::max(seen_to, last);
  }
  return sum;
}

PixelRun rows_of(const Outline& outline, std::span<const Disc> discs) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  const auto include = [&](double y, double radius) {
    low = std::min(low, y - radius), high = std::max(high, y + radius);
  };
  for (const Vec2& point : outline.points) include(static_cast<double>(point.y), 0);
  for (const Disc& disc : discs) include(static_cast<double>(disc.y), static_cast<double>(disc.radius));
  return low <= high ? pixels_between(low, high) : PixelRun{0, 0};
}

}  // namespace

Coverage rasterise(const Outline& outline, std::span<const Disc> discs) {
  std::int64_t of_discs = 0, of_both = 0, of_outline = 0;
  std::vector<double> crossings;
  std::vector<PixelRun> runs, inside;
  const auto [first, last] = rows_of(outline, discs);
  for (std::int64_t row = first; row < last; ++row) {
    const double y = (static_cast<double>(row) + 0.5) * pixel;
    runs.clear(), inside.clear();
    add_discs(discs, y, runs);
    add_crossings(outline, y, crossings, inside);
    of_discs += count(runs);
    of_outline += count(inside);
    runs.insert(runs.end(), inside.begin(), inside.end());
    of_both += count(runs);
  }
  const auto area = [](std::int64_t pixels) { return static_cast<double>(pixels) * pixel * pixel; };
  return {area(of_discs), area(of_both), area(of_outline)};
}

}  // namespace bch::report
