// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/culling/contour_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bch::detail {
namespace {

PointLanes centres(const CandidateDiscs& discs) {
  return {discs.x.data(), discs.y.data(), discs.count};
}

/// Returns the point nearest to a place on the contour's edge that ends at point i.
Vec2 nearest_on_edge(const ContourPoints& contour, std::size_t i, float at_x, float at_y) {
  const std::size_t before = (i == 0 ? contour.count : i) - 1;
  const float x = contour.x[before], y = contour.y[before], dx = contour.x[i] - x, dy = contour.y[i] - y;
  const float length = dx * dx + dy * dy;
  if (length <= std::numeric_limits<float>::min()) return {x, y};
  const float t = std::clamp(((at_x - x) * dx + (at_y - y) * dy) / length, 0.0f, 1.0f);
  return {x + t * dx, y + t * dy};
}

}  // namespace

void measure_depths(const InteriorLoops& loops, std::span<const Vec2> contour, const CandidateDiscs& discs,
                    ContourDepths& depths) {
  loops.measure(contour.data(), contour.size(), centres(discs), depths.distance.data(),
                depths.winding.data());
  for (std::uint32_t k = 0; k < discs.count; ++k) {
    depths.distance[k] = std::sqrt(depths.distance[k]);
    depths.winding[k] *= 0.25;
  }
}

void estimate_depths(const InteriorLoops& loops, const ContourPoints& contour, const CandidateDiscs& discs,
                     ContourDepths& depths) {
  alignas(64) std::array<float, max_touches> square, turns;
  loops.estimate(contour, centres(discs), square.data(), turns.data());
  for (std::uint32_t k = 0; k < discs.count; ++k) {
    depths.distance[k] = static_cast<double>(std::sqrt(square[k]));
    depths.winding[k] = 0.25 * static_cast<double>(turns[k]);
  }
}

void nearest_touches(const InteriorLoops& loops, const ContourPoints& contour, const CandidateDiscs& discs,
                     Touches& touches) {
  alignas(64) std::array<float, max_touches> square;
  alignas(64) std::array<std::int32_t, max_touches> edge;
  loops.find_nearest(contour, centres(discs), square.data(), edge.data());
  touches.count = discs.count;
  for (std::uint32_t k = 0; k < discs.count; ++k) {
    const Vec2 at = nearest_on_edge(contour, static_cast<std::size_t>(edge[k]), discs.x[k], discs.y[k]);
    const float x = discs.x[k] - at.x, y = discs.y[k] - at.y, distance = std::sqrt(x * x + y * y);
    const float over = distance > 0 ? 1 / distance : 0;
    touches.x[k] = at.x, touches.y[k] = at.y;
    touches.normal_x[k] = x * over, touches.normal_y[k] = y * over;
  }
}

}  // namespace bch::detail
