// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/characters/crowd.hpp"
#include "layout/base/random.hpp"

#include <cmath>
#include <numbers>

namespace bch::cli {

Crowd place_crowd(std::uint32_t agents, double density, std::uint32_t shapes, std::uint64_t seed) {
  detail::Random random(seed);
  Crowd crowd;
  crowd.side = std::sqrt(agents / density);
  for (std::uint32_t i = 0; i < agents; ++i) {
    crowd.x.push_back(random.uniform(crowd.side));
    crowd.y.push_back(random.uniform(crowd.side));
    crowd.heading.push_back(random.uniform(2 * std::numbers::pi));
    crowd.shape.push_back(random.below(shapes));
  }
  return crowd;
}

}  // namespace bch::cli
