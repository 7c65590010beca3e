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
    throw std::invalid_argument("planes: " + std::to_string(planes.size()) + " planes, more than " +
                                std::to_string(most_planes));
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (!(std::abs(planes[i]) <= 1e6f))
      throw std::invalid_argument("planes: plane " + std::to_string(i) + " at " + shortest(planes[i]) +
                                  " m is not within 1e6 m");
    if (i > 0 && !(planes[i - 1] < planes[i]))
      throw std::invalid_argument("planes: plane " + std::to_string(i) + " at " + shortest(planes[i]) +
                                  " m does not ascend");
  }
}

double height_of(float plane) {
  return 0.5 * (double{plane} + double{std::nextafter(plane, std::numeric_limits<float>::infinity())});
}

}  // namespace bch::detail
