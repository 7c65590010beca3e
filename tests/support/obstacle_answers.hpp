// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "kernel/runtime/all_options.hpp"
#include "tests/support/scenes.hpp"

namespace bch::test {

/// What all queries say of a scene.
struct ObstacleAnswers {
  std::vector<std::uint8_t> hits, near;
  std::vector<float> distance, deepest, time;
  std::vector<Vec2> direction;
  std::vector<DiscPair> discs, deepest_discs;
  std::vector<NearestPoints> points;
  std::vector<Penetration> ways;
  friend bool operator==(const ObstacleAnswers&, const ObstacleAnswers&) = default;
};

inline ObstacleAnswers all_answers(const ShapeSet& set, const Agents& agents, const ObstacleSet& obstacles,
                                   const detail::AllOptions& options, std::span<const double> distances,
                                   const Displacements& displacements) {
  const std::size_t n = agents.size();
  ObstacleAnswers all{std::vector<std::uint8_t>(n),  std::vector<std::uint8_t>(n),
                      std::vector<float>(n),         std::vector<float>(n),
                      std::vector<float>(n),         std::vector<Vec2>(n),
                      std::vector<DiscPair>(n),      std::vector<DiscPair>(n),
                      std::vector<NearestPoints>(n), std::vector<Penetration>(n)};
  collide(set, agents, obstacles, all.hits, options);
  within(set, agents, obstacles, distances, all.near, options.distance_leaves, options.implementation);
  detail::AllOptions how = options;
  clearance(set, agents, obstacles, {all.distance, all.direction, all.discs, all.points}, how);
  how.overlap = Overlap::deepest;
  clearance(set, agents, obstacles, {.distance = all.deepest, .discs = all.deepest_discs}, how);
  penetration(set, agents, obstacles, all.ways, options);
  time_of_impact(set, agents, displacements, obstacles, all.time, options);
  return all;
}

/// Returns the largest float that is not above a number: what queries make of a distance.
inline float rounded_down(double value) {
  const float nearest = static_cast<float>(value);
  return static_cast<double>(nearest) > value ? std::nextafter(nearest, -HUGE_VALF) : nearest;
}

/// Distances to ask about, some of them 0.
inline std::vector<double> distances_for(Random& random, std::size_t count) {
  std::vector<double> distances;
  for (std::size_t i = 0; i < count; ++i)
    distances.push_back(random.below(8) == 0 ? 0 : random.uniform(0, 1));
  return distances;
}

}  // namespace bch::test
