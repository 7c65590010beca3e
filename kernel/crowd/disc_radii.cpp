// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/crowd/disc_radii.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace bch::detail {
namespace {

/// Keeps the weights of bodies that touch finite; metres. With 0.05 to 0.4 m, simulated people overlap as often.
constexpr double softening = 0.1;

/// Returns a difference of coordinates; with a period, the nearest to 0.
double difference(double from, double to, double period) noexcept {
  return period > 0 ? std::remainder(to - from, period) : to - from;
}

struct WeightedSum {
  double sum = 0, weight = 0;
};

}  // namespace

std::vector<double> disc_radii(std::span<const Pair> pairs, std::span<const float> clearance,
                               const Agents& agents, CrowdOptions::Period period, double alone) {
  std::vector<WeightedSum> half_distances(agents.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto [a, b] = pairs[i];
    const double x = difference(agents.x[a], agents.x[b], period.x),
                 y = difference(agents.y[a], agents.y[b], period.y), gap{clearance[i]};
    const double touching = std::max(0.0, std::sqrt(x * x + y * y) - gap),
                 soft = std::max(0.0, gap) + softening;
    for (const std::uint32_t agent : {a, b}) {
      half_distances[agent].sum += touching / 2 / (soft * soft);
      half_distances[agent].weight += 1 / (soft * soft);
    }
  }
  std::vector<double> radii(agents.size(), alone);
  for (std::size_t i = 0; i < radii.size(); ++i)
    if (const auto [sum, weight] = half_distances[i]; weight > 0) radii[i] = sum / weight;
  return radii;
}

}  // namespace bch::detail
