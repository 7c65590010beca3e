// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/interior.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "layout/enclosing_disc.hpp"
#include "layout/heading.hpp"
#include "layout/rounding.hpp"

namespace bch {
namespace {

using Contour = std::span<const Vec2>;

/// Calls visit(ax, ay, bx, by) for every segment.
template <class Visit>
void for_each_segment(Contour contour, Visit visit) {
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const Vec2 a = contour[i], b = contour[i + 1 < contour.size() ? i + 1 : 0];
    visit(static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(b.x),
          static_cast<double>(b.y));
  }
}

/// Distance to the contour where (x, y) is inside it, else 0.
double depth_inside(Contour contour, double x, double y) {
  bool inside = false;
  double square = HUGE_VAL;
  for_each_segment(contour, [&](double ax, double ay, double bx, double by) {
    const double dx = bx - ax, dy = by - ay, px = x - ax, py = y - ay;
    if ((ay > y) != (by > y)) inside ^= (dx * py - dy * px > 0) == (by > ay);
    const double length = dx * dx + dy * dy;
    const double t = length > 0 ? std::clamp((px * dx + py * dy) / length, 0.0, 1.0) : 0.0;
    square = std::min(square, (px - t * dx) * (px - t * dx) + (py - t * dy) * (py - t * dy));
  });
  return inside ? std::sqrt(square) : 0;
}

/// A raster over the dilated contour, and the discs inside it that are centred on raster points.
class Coverage {
 public:
  Coverage(Contour contour, const EnclosingDisc& around)
      : dilation_(0.25 * around.radius),
        step_(2 * (around.radius + dilation_) / raster),
        x_(static_cast<double>(around.centre.x) - around.radius - dilation_),
        y_(static_cast<double>(around.centre.y) - around.radius - dilation_),
        covered_(raster * raster) {
    for (int j = 0; j < raster; ++j)
      for (int i = 0; i < raster; ++i) {
        // Centres are floats, as they will be stored.
        const auto x = static_cast<float>(x_ + (i + 0.5) * step_),
                   y = static_cast<float>(y_ + (j + 0.5) * step_);
        const double depth = depth_inside(contour, x, y);
        if (depth > 0) candidates_.push_back({x, y, depth, raster * raster});
      }
  }

  struct Candidate {
    float x, y;
    double depth;
    int gain;  ///< raster points that it would add, at most
  };

  /// The disc that adds the most; its points count as covered from now on. Gains only shrink as others are
  /// chosen, so a candidate whose old gain does not beat the best new one needs no look.
  Candidate choose() {
    Candidate* best = nullptr;
    int best_gain = -1;
    std::sort(candidates_.begin(), candidates_.end(),
              [](const Candidate& a, const Candidate& b) { return a.gain > b.gain; });
    for (Candidate& candidate : candidates_) {
      if (candidate.gain <= best_gain) break;
      candidate.gain = 0;
      visit_new_points(candidate, [&](std::size_t) { ++candidate.gain; });
      if (candidate.gain > best_gain) best = &candidate, best_gain = candidate.gain;
    }
    visit_new_points(*best, [&](std::size_t point) { covered_[point] = true; });
    return *best;
  }

  bool empty() const { return candidates_.empty(); }

 private:
  static constexpr int raster = 48;

  template <class Visit>
  void visit_new_points(const Candidate& c, Visit visit) {
    const double radius = c.depth + dilation_;
    const double cx = (static_cast<double>(c.x) - x_) / step_ - 0.5,
                 cy = (static_cast<double>(c.y) - y_) / step_ - 0.5;
    const double r = radius / step_;
    const int j0 = std::max(0, static_cast<int>(std::ceil(cy - r))),
              j1 = std::min(raster - 1, static_cast<int>(std::floor(cy + r)));
    for (int j = j0; j <= j1; ++j) {
      const double half = std::sqrt(std::max(0.0, r * r - (j - cy) * (j - cy)));
      const int i0 = std::max(0, static_cast<int>(std::ceil(cx - half))),
                i1 = std::min(raster - 1, static_cast<int>(std::floor(cx + half)));
      for (int i = i0; i <= i1; ++i) {
        const auto point = static_cast<std::size_t>(j * raster + i);
        if (!covered_[point]) visit(point);
      }
    }
  }

  double dilation_, step_, x_, y_;
  std::vector<std::uint8_t> covered_;
  std::vector<Candidate> candidates_;
};

double twice_area(Contour contour) {
  double sum = 0;
  for_each_segment(contour, [&](double ax, double ay, double bx, double by) { sum += ax * by - ay * bx; });
  return sum;
}

Contour largest_contour(const Outline& outline) {
  Contour largest = outline.contour(0);
  for (std::size_t c = 1; c < outline.contours(); ++c)
    if (twice_area(outline.contour(c)) > twice_area(largest)) largest = outline.contour(c);
  return largest;
}

void set_extremes(Contour contour, Interior& result) {
  for (std::uint32_t k = 0; k < extreme_stride; ++k) {
    const Rotation direction = rotation(2 * std::numbers::pi * (k % extreme_directions) / extreme_directions);
    const auto along = [&](Vec2 p) {
      return direction.cosine * static_cast<double>(p.x) + direction.sine * static_cast<double>(p.y);
    };
    const Vec2 farthest = *std::max_element(contour.begin(), contour.end(),
                                            [&](Vec2 a, Vec2 b) { return along(a) < along(b); });
    result.extreme_x[k] = farthest.x;
    result.extreme_y[k] = farthest.y;
  }
}

}  // namespace

Interior interior(const Outline& outline, double reach) {
  const Contour contour = largest_contour(outline);
  const EnclosingDisc around = smallest_enclosing_disc(contour);
  Interior result;
  result.x.fill(std::numeric_limits<float>::infinity());
  result.y.fill(0);
  result.radius.fill(0);
  set_extremes(contour, result);

  Coverage coverage(contour, around);
  if (coverage.empty()) return result;
  for (std::uint32_t k = 0; k < block_width; ++k) {
    const auto disc = coverage.choose();
    const double radius = disc.depth * (1 - 0x1p-23) - rounding::query_margin * reach;
    if (!(radius > 0)) continue;
    result.x[k] = disc.x, result.y[k] = disc.y;
    result.radius[k] = static_cast<float>(radius);
  }
  return result;
}

}  // namespace bch
