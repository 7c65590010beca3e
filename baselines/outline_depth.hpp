// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <bch/outline.hpp>

#include "layout/base/plane_point.hpp"

namespace bch::baselines {

/// Returns how deep a point is inside an outline, or less than 0 outside of it: the distance from the nearest segment.
inline double depth_in(const Outline& outline, const detail::PlanePoint& point) {
  double nearest = std::numeric_limits<double>::infinity();
  bool inside = false;
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    const auto contour = outline.contour(c);
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const detail::PlanePoint a = detail::plane_point(contour[i]),
                               b = detail::plane_point(contour[(i + 1) % contour.size()]);
      nearest = std::min(nearest, detail::squared_distance(point, a, b));
      if ((a.y > point.y) != (b.y > point.y))
        inside ^= point.x - a.x < (b.x - a.x) * ((point.y - a.y) / (b.y - a.y));
    }
  }
  return inside ? std::sqrt(nearest) : -std::sqrt(nearest);
}

}  // namespace bch::baselines
