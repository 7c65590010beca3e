// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/outline_checks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace bch::test {
namespace {

struct Point {
  double x, y;
};

Point flat(const Vec3& p) {
  return {p.x, p.y};
}
double cross(Point a, Point b, Point p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

double distance(Point p, Point a, Point b) {
  const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
  const double t = square > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / square, 0.0, 1.0) : 0.0;
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

/// The triangles as seen from above, with the raster rows that each one meets.
class Samples {
 public:
  Samples(Positions positions, Triangles triangles, int resolution, double margin)
      : n_(resolution), covered_(n_ * n_), unclear_(n_ * n_), wall_x_(n_ * n_), wall_y_(n_ * n_) {
    double low_x = HUGE_VAL, low_y = HUGE_VAL, high_x = -HUGE_VAL, high_y = -HUGE_VAL;
    for (const auto& t : triangles)
      for (const auto v : t) {
        const Point p = flat(positions[v]);
        low_x = std::min(low_x, p.x), high_x = std::max(high_x, p.x), low_y = std::min(low_y, p.y),
        high_y = std::max(high_y, p.y);
      }
    step_ = std::max(high_x - low_x, high_y - low_y) / (n_ - 3.5) + 1e-9;
    x_ = low_x - 1.37 * step_, y_ = low_y - 1.29 * step_;
    for (const auto& t : triangles)
      mark(flat(positions[t[0]]), flat(positions[t[1]]), flat(positions[t[2]]), margin);
    flood();
  }

  int size() const { return n_; }
  Point at(int i, int j) const { return {x_ + i * step_, y_ + j * step_}; }
  bool clear(int i, int j) const { return !unclear_[index(i, j)]; }
  bool covered(int i, int j) const { return covered_[index(i, j)]; }
  bool reached(int i, int j) const { return reached_[index(i, j)]; }

 private:
  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(n_) + static_cast<std::size_t>(i);
  }

  static bool meets(Point p, Point q, Point a, Point b) {
    return (cross(a, b, p) >= 0) != (cross(a, b, q) > 0) && (cross(p, q, a) >= 0) != (cross(p, q, b) > 0);
  }

  void mark(Point a, Point b, Point c, double margin) {
    const auto cell = [&](double v, double origin) {
      return static_cast<int>(std::floor((v - origin) / step_));
    };
    const int i0 = std::max(0, cell(std::min({a.x, b.x, c.x}), x_) - 1),
              i1 = std::min(n_ - 1, cell(std::max({a.x, b.x, c.x}), x_) + 1);
    const int j0 = std::max(0, cell(std::min({a.y, b.y, c.y}), y_) - 1),
              j1 = std::min(n_ - 1, cell(std::max({a.y, b.y, c.y}), y_) + 1);
    for (int j = j0; j <= j1; ++j)
      for (int i = i0; i <= i1; ++i) {
        const Point p = at(i, j), right = at(i + 1, j), up = at(i, j + 1);
        const double s = cross(a, b, p), t = cross(b, c, p), u = cross(c, a, p);
        if ((s >= 0 && t >= 0 && u >= 0) || (s <= 0 && t <= 0 && u <= 0)) covered_[index(i, j)] = true;
        for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
          if (distance(p, from, to) <= margin) unclear_[index(i, j)] = true;
          if (meets(p, right, from, to)) wall_x_[index(i, j)] = true;
          if (meets(p, up, from, to)) wall_y_[index(i, j)] = true;
        }
      }
  }

  void flood() {
    reached_.assign(covered_.size(), false);
    std::vector<std::pair<int, int>> open = {{0, 0}};
    reached_[0] = true;
    const auto visit = [&](int i, int j, bool wall) {
      if (i < 0 || j < 0 || i >= n_ || j >= n_ || wall || covered(i, j) || !clear(i, j) || reached(i, j))
        return;
      reached_[index(i, j)] = true;
      open.push_back({i, j});
    };
    while (!open.empty()) {
      const auto [i, j] = open.back();
      open.pop_back();
      visit(i + 1, j, wall_x_[index(i, j)]);
      visit(i, j + 1, wall_y_[index(i, j)]);
      if (i > 0) visit(i - 1, j, wall_x_[index(i - 1, j)]);
      if (j > 0) visit(i, j - 1, wall_y_[index(i, j - 1)]);
    }
  }

  int n_;
  double x_, y_, step_;
  std::vector<bool> covered_, unclear_, wall_x_, wall_y_, reached_;
};

}  // namespace

bool inside(const Outline& outline, double x, double y) {
  bool odd = false;
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    const auto contour = outline.contour(c);
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const Point a{contour[i].x, contour[i].y},
          b{contour[(i + 1) % contour.size()].x, contour[(i + 1) % contour.size()].y};
      if ((a.y > y) != (b.y > y)) odd ^= (cross(a, b, {x, y}) > 0) == (b.y > a.y);
    }
  }
  return odd;
}

double distance_to(const Outline& outline, double x, double y) {
  double smallest = HUGE_VAL;
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    const auto contour = outline.contour(c);
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const Vec2 a = contour[i], b = contour[(i + 1) % contour.size()];
      smallest = std::min(smallest, distance({x, y}, {a.x, a.y}, {b.x, b.y}));
    }
  }
  return smallest;
}

void expect_covers(const Outline& outline, Positions positions, Triangles triangles) {
  const double margin = 1.5 * static_cast<double>(outline.grid_step);
  const auto check = [&](Point p) {
    if (inside(outline, p.x, p.y)) return;
    ASSERT_LE(distance_to(outline, p.x, p.y), margin) << p.x << ", " << p.y;
  };
  for (const auto& t : triangles)
    for (int k = 0; k < 3; ++k) {
      const Point a = flat(positions[t[k]]), b = flat(positions[t[(k + 1) % 3]]);
      for (const double s : {0.0, 0.31, 0.74}) check({a.x + s * (b.x - a.x), a.y + s * (b.y - a.y)});
    }
}

void expect_equals_samples(const Outline& outline, Positions positions, Triangles triangles, int resolution) {
  const Samples samples(positions, triangles, resolution, 3 * static_cast<double>(outline.grid_step));
  for (int j = 0; j < samples.size(); ++j)
    for (int i = 0; i < samples.size(); ++i) {
      if (!samples.clear(i, j)) continue;
      const Point p = samples.at(i, j);
      const bool is_inside = inside(outline, p.x, p.y);
      ASSERT_FALSE(samples.covered(i, j) && !is_inside) << p.x << ", " << p.y;
      ASSERT_FALSE(samples.reached(i, j) && is_inside) << p.x << ", " << p.y;
    }
}

}  // namespace bch::test
