// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/mpi/crowd.hpp"

#include <cmath>
#include <numbers>

#include "layout/base/random.hpp"

namespace bch::cli {

using std::numbers::pi;

namespace {

constexpr double street_width = 10, block = 100;

bool in_street(double across) {
  return across - block * std::floor(across / block) < street_width;
}

}  // namespace

const std::vector<std::string> scenery_kinds = {"uniform", "spot", "stadium", "street"};

Scenery::Scenery(const std::string& kind, std::uint64_t agents, double density) {
  const double area = static_cast<double>(agents) / density, half = std::sqrt(area) / 2;
  const auto square = [](double fraction, double half_side) {
    return Layer{fraction, half_side, false, false, 0, 0, 0, 0};
  };
  const auto ring = [&](double fraction, double times_density, double inner, double x) {
    const double ring_area = fraction * area / times_density;
    const double outer = std::sqrt(ring_area / (pi * (1 - inner * inner)));
    return Layer{fraction, 0, false, false, inner * outer, outer, x, x};
  };
  const auto streets = [&](bool rows) {
    const double half_side = std::sqrt(area / 2 * (block / street_width)) / 2;
    return Layer{0.5, half_side, rows, !rows, 0, 0, 0, 0};
  };
  if (kind == "spot")
    layers_ = {square(0.75, half * std::sqrt(0.75)), ring(0.25, 4, 0, half / 3)};
  else if (kind == "stadium")
    layers_ = {square(0.5, half), ring(0.5, 2, 0.5, 0)};
  else if (kind == "street")
    layers_ = {streets(true), streets(false)};
  else
    layers_ = {square(1, half)};
}

bool Scenery::Layer::contains(double px, double py) const {
  if (outer > 0) {
    const double squared = (px - x) * (px - x) + (py - y) * (py - y);
    return squared <= outer * outer && squared >= inner * inner;
  }
  return std::abs(px) <= half_side && std::abs(py) <= half_side && (!rows || in_street(py)) &&
         (!columns || in_street(px));
}

DistributedCrowd::Agent Scenery::agent(std::uint64_t number, std::uint32_t shapes) const {
  detail::Random random(number);
  const double chosen = random.uniform(1);
  const Layer& layer = chosen < layers_[0].fraction ? layers_[0] : layers_.back();
  DistributedCrowd::Agent agent;
  agent.heading = 2 * pi * random.uniform(1);
  agent.id = static_cast<std::uint32_t>(number);
  agent.shape = static_cast<std::uint32_t>(random.uniform(1) * shapes);
  do {  // streets are a tenth of their square, rings at least a half of theirs
    const double reach = layer.outer > 0 ? layer.outer : layer.half_side;
    agent.x = layer.x + reach * (2 * random.uniform(1) - 1);
    agent.y = layer.y + reach * (2 * random.uniform(1) - 1);
  } while (!layer.contains(agent.x, agent.y));
  return agent;
}

}  // namespace bch::cli
