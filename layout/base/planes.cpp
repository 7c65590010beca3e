// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/base/planes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "layout/base/shortest.hpp"

namespace bch::detail {

void require_planes(std::span<const float> planes) {
  if (planes.size() > most_planes)
    throw std::invalid_argument("slices: " + std::to_string(planes.size()) + " planes, more than " +
                                std::to_string(most_planes));
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (!(std::abs(planes[i]) <= 1e6f))
      throw std::invalid_argument("slices: plane " + std::to_string(i) + " at " + shortest(planes[i]) +
                                  " m is not within 1e6 m");
    if (i > 0 && !(planes[i - 1] < planes[i]))
      throw std::invalid_argument("slices: plane " + std::to_string(i) + " at " + shortest(planes[i]) +
                                  " m does not ascend");
  }
}

double height_of(float plane) {
  return 0.5 * (double{plane} + double{std::nextafter(plane, std::numeric_limits<float>::infinity())});
}

/// A plane is above the float that names it, and below the next one.
Heights heights_of_slab(Heights body, std::span<const float> planes, std::size_t slab) {
  const float infinite = std::numeric_limits<float>::infinity();
  Heights within = body;
  if (slab < planes.size()) {
    if (!(body.bottom <= planes[slab])) return {infinite, -infinite};
    within.top = std::min(body.top, std::nextafter(planes[slab], infinite));
  }
  if (slab > 0) {
    if (!(planes[slab - 1] < body.top)) return {infinite, -infinite};
    within.bottom = std::max(body.bottom, planes[slab - 1]);
  }
  return within;
}

}  // namespace bch::detail
