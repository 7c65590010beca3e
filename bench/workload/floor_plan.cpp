// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/workload/floor_plan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "layout/base/random.hpp"

namespace bch::bench {
namespace {

constexpr double room = 6, door = 1, pillar = 0.2;  ///< metres
constexpr std::uint32_t corners = 8;

void add(FloorPlan& plan, const std::vector<double>& x, const std::vector<double>& y, bool is_area) {
  plan.x.insert(plan.x.end(), x.begin(), x.end());
  plan.y.insert(plan.y.end(), y.begin(), y.end());
  plan.path_offsets.push_back(plan.x.size());
  plan.is_area.push_back(is_area);
  baselines::ReferenceObstacle obstacle{{}, is_area};
  for (std::size_t i = 1; i < x.size(); ++i) obstacle.segments.push_back({x[i - 1], y[i - 1], x[i], y[i]});
  if (is_area) obstacle.segments.push_back({x.back(), y.back(), x[0], y[0]});
  plan.reference.push_back(std::move(obstacle));
}

/// A side of a room, with a door: two lines of so many pieces each.
void add_wall(FloorPlan& plan, double x, double y, bool upright, double length, std::uint32_t pieces) {
  for (const double begin : {0.0, (length + door) / 2}) {
    std::vector<double> along, beside;
    for (std::uint32_t i = 0; i <= pieces; ++i) {
      along.push_back((upright ? y : x) + begin + (length - door) / 2 * i / pieces);
      beside.push_back(upright ? x : y);
    }
    upright ? add(plan, beside, along, false) : add(plan, along, beside, false);
  }
}

}  // namespace

FloorPlan floor_plan(std::uint32_t segments, double side, std::uint64_t seed) {
  FloorPlan plan;
  detail::Random random(seed);
  const std::uint32_t pillars = segments * 2 / 5 / corners;
  const auto rooms = std::max<std::uint32_t>(1, static_cast<std::uint32_t>(std::lround(side / room)));
  const double length = side / rooms;
  const std::uint32_t pieces =
      std::max<std::uint32_t>(1, (segments - pillars * corners) / (4 * rooms * rooms));
  for (std::uint32_t i = 0; i < rooms; ++i)
    for (std::uint32_t j = 0; j < rooms; ++j)
      for (const bool upright : {false, true})
        add_wall(plan, i * length, j * length, upright, length, pieces);
  for (std::uint32_t i = 0; i < pillars; ++i) {
    const double x = random.uniform(side), y = random.uniform(side);
    std::vector<double> px, py;
    for (std::uint32_t k = 0; k < corners; ++k) {
      px.push_back(x + pillar * std::cos(2 * std::numbers::pi * k / corners));
      py.push_back(y + pillar * std::sin(2 * std::numbers::pi * k / corners));
    }
    add(plan, px, py, true);
  }
  return plan;
}

}  // namespace bch::bench
