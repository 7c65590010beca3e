// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <string>
#include <vector>

#include <bch/clearance.hpp>
#include <bch/time_of_impact.hpp>

#include "bench/workload/scene.hpp"

// What the benchmarks of distances and times ask for, and what answers must be before they are worth timing.

namespace bch::bench {

constexpr double clearance_limit = 0.5;  ///< metres
constexpr double personal_space = 0.1;   ///< metres, that within() asks for
constexpr double walking_speed = 1.3;    ///< metres a second, along the heading
constexpr double walking_time = 0.5;     ///< seconds

/// Holds clearances with their directions.
struct Clearances {
  std::vector<float> distance;
  std::vector<Vec2> direction;

  explicit Clearances(std::size_t pairs) : distance(pairs), direction(pairs) {}
  ClearanceAnswers spans() { return {distance, direction}; }
};

/// Holds the relative motion of the agents of each pair when all walk.
struct Ways {
  std::vector<double> x, y;

  explicit Ways(const Workload& workload);
  Displacements displacements() const { return {x, y}; }
};

/// The functions below return where answers differ from brute force over all discs, on every pair; empty:
/// nowhere.
std::string wrong_clearances(Scene& scene, const Workload& workload, const Clearances& answers);
/// Checks clearances of exact leaves: all of them against those of discs, and one in 64 against brute force over all segments.
std::string wrong_exact_clearances(Scene& scene, const Workload& workload, const Clearances& answers);
std::string wrong_within(Scene& scene, const Workload& workload, const Hits& answers);
/// Checks distances of outlines, which clearances bound.
std::string wrong_distances(Scene& scene, const Workload& workload, const std::vector<double>& distances);
std::string wrong_times_of_impact(Scene& scene, const Workload& workload, const std::vector<float>& times);

}  // namespace bch::bench
