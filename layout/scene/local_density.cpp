// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/scene_plan.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <tuple>

#include "layout/base/floating_point_state.hpp"
#include "layout/base/number_class.hpp"
#include "layout/base/shortest.hpp"

namespace bch {

using namespace detail;

namespace {

constexpr double largest_position = 1e9;  // metres

void require(std::span<const double> x, std::span<const double> y, double radius) {
  if (x.size() != y.size())
    throw std::invalid_argument("local density: expected " + std::to_string(x.size()) +
                                " values of y, as many as of x, found " + std::to_string(y.size()));
  if (!(radius > 0) || !is_finite(radius))
    throw std::invalid_argument("local density: expected a radius above 0 m, found " + shortest(radius));
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!(std::abs(x[i]) <= largest_position) || !(std::abs(y[i]) <= largest_position))
      throw std::invalid_argument("local density: agent " + std::to_string(i) +
                                  ": expected a finite position, found (" + shortest(x[i]) + ", " +
                                  shortest(y[i]) + ")");
}

/// Agents by the rows of a grid and, within a row, by x, so that neighbours are runs of three rows.
struct StandingPlace {
  double row, x, y;

  bool operator<(const StandingPlace& other) const { return std::tie(row, x) < std::tie(other.row, other.x); }
};

std::size_t count_within(const std::vector<StandingPlace>& places, double x, double y, double radius) {
  std::size_t count = 0;
  for (int side = -1; side <= 1; ++side) {
    const double row = std::floor(y / radius) + side;
    auto at = std::lower_bound(places.begin(), places.end(), StandingPlace{row, x - radius, 0});
    for (; at != places.end() && at->row == row && at->x <= x + radius; ++at)
      count += (at->x - x) * (at->x - x) + (at->y - y) * (at->y - y) <= radius * radius ? 1 : 0;
  }
  return count;
}

}  // namespace

std::vector<double> local_densities(std::span<const double> x, std::span<const double> y, double radius) {
  const FloatingPointStateGuard floats;
  require(x, y, radius);
  std::vector<StandingPlace> places;
  for (std::size_t i = 0; i < x.size(); ++i) places.push_back({std::floor(y[i] / radius), x[i], y[i]});
  std::sort(places.begin(), places.end());
  std::vector<double> densities;
  for (std::size_t i = 0; i < x.size(); ++i)
    densities.push_back(static_cast<double>(count_within(places, x[i], y[i], radius)) /
                        (std::numbers::pi * radius * radius));
  return densities;
}

}  // namespace bch
