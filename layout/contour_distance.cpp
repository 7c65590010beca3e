// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/contour_distance.hpp"

#include <cmath>
#include <limits>
#include <utility>

// Loops run over the points within one over the edges: what belongs to an edge is computed once, and each
// point is a lane of its own, so that nothing is summed across lanes. They have no two conditions in a row,
// which GCC 12 makes branches of, and then no vectors.

namespace bch {
namespace {

/// t held to 0 ... 1. Off by a rounding of t, which beside an edge of length l, where t = distance / l, is no
/// more than a rounding of the distance.
template <class Real>
Real clamp_to_edge(Real t) {
  return Real(0.5) * (std::abs(t) - std::abs(t - 1) + 1);
}

/// An edge in float, and the way from its nearest point.
struct Edge {
  float x, y, dx, dy, over;

  Edge(std::span<const float> xs, std::span<const float> ys, std::int32_t from, std::int32_t to)
      : x(at(xs, from)), y(at(ys, from)), dx(at(xs, to) - x), dy(at(ys, to) - y) {
    const float length = dx * dx + dy * dy;
    over = length > std::numeric_limits<float>::min() ? 1 / length : 0;
  }
  Vec2 way_to(float at_x, float at_y) const {
    const float px = at_x - x, py = at_y - y, t = clamp_to_edge((px * dx + py * dy) * over);
    return {px - t * dx, py - t * dy};
  }

 private:
  static float at(std::span<const float> values, std::int32_t i) {
    return values[static_cast<std::size_t>(i)];
  }
};

/// corner(i): the coordinates of point i of the contour's n.
template <class Real, class Corner>
void measure(std::size_t n, Corner corner, const CandidateDiscs& discs, ContourDepths& depths) {
  alignas(64) std::array<Real, most_touches> at_x, at_y, square, turns;
  for (std::uint32_t k = 0; k < discs.count; ++k) at_x[k] = static_cast<Real>(discs.x[k]);
  for (std::uint32_t k = 0; k < discs.count; ++k) at_y[k] = static_cast<Real>(discs.y[k]);
  square.fill(std::numeric_limits<Real>::infinity());
  turns.fill(0);
  for (std::size_t i = 0, before = n - 1; i < n; before = i++) {
    const auto [ax, ay] = corner(before);
    const auto [bx, by] = corner(i);
    const Real x = ax, y = ay, end_y = by, dx = bx - ax, dy = by - ay, length = dx * dx + dy * dy;
    const Real over = length > std::numeric_limits<Real>::min() ? 1 / length : 0;
    for (std::uint32_t k = 0; k < discs.count; ++k) {
      const Real px = at_x[k] - x, py = at_y[k] - y;
      const Real t = clamp_to_edge((px * dx + py * dy) * over);
      const Real ex = px - t * dx, ey = py - t * dy, here = ex * ex + ey * ey;
      square[k] = here < square[k] ? here : square[k];
      // An edge that crosses the point's height has it on its left or on its right; the others count 0.
      const Real from = std::copysign(Real(1), y - at_y[k]), to = std::copysign(Real(1), end_y - at_y[k]),
                 side = std::copysign(Real(1), dx * py - dy * px);
      turns[k] += (1 - from * to) * side;
    }
  }
  for (std::uint32_t k = 0; k < discs.count; ++k) {
    depths.distance[k] = static_cast<double>(std::sqrt(square[k]));
    depths.winding[k] = 0.25 * static_cast<double>(turns[k]);
  }
}

}  // namespace

void measure_depths(std::span<const Vec2> contour, const CandidateDiscs& discs, ContourDepths& depths) {
  const auto corner = [&](std::size_t i) {
    return std::pair{static_cast<double>(contour[i].x), static_cast<double>(contour[i].y)};
  };
  measure<double>(contour.size(), corner, discs, depths);
}

void estimate_depths(std::span<const float> contour_x, std::span<const float> contour_y,
                     const CandidateDiscs& discs, ContourDepths& depths) {
  const auto corner = [&](std::size_t i) { return std::pair{contour_x[i], contour_y[i]}; };
  measure<float>(contour_x.size(), corner, discs, depths);
}

void nearest_touches(std::span<const float> contour_x, std::span<const float> contour_y,
                     const CandidateDiscs& discs, Touches& touches) {
  const auto n = static_cast<std::int32_t>(contour_x.size());
  alignas(64) std::array<float, most_touches> square;
  alignas(64) std::array<std::int32_t, most_touches> nearest = {};
  square.fill(std::numeric_limits<float>::infinity());
  for (std::int32_t i = 0, before = n - 1; i < n; before = i++) {
    const Edge edge(contour_x, contour_y, before, i);
    for (std::uint32_t k = 0; k < discs.count; ++k) {
      const Vec2 way = edge.way_to(discs.x[k], discs.y[k]);
      const float here = way.x * way.x + way.y * way.y;
      const std::int32_t nearer = -static_cast<std::int32_t>(here < square[k]);  // all bits or none
      nearest[k] ^= (nearest[k] ^ i) & nearer;
      square[k] = here < square[k] ? here : square[k];
    }
  }
  touches.count = discs.count;
  for (std::uint32_t k = 0; k < discs.count; ++k) {
    const std::int32_t i = nearest[k], before = (i == 0 ? n : i) - 1;
    const Vec2 way = Edge(contour_x, contour_y, before, i).way_to(discs.x[k], discs.y[k]);
    const float over = square[k] > 0 ? 1 / std::sqrt(square[k]) : 0;
    touches.x[k] = discs.x[k] - way.x, touches.y[k] = discs.y[k] - way.y;
    touches.normal_x[k] = way.x * over, touches.normal_y[k] = way.y * over;
  }
}

}  // namespace bch
