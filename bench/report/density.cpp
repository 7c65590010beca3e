// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include <bch/crowd.hpp>
#include <bch/pairs.hpp>
#include <bch/scene_plan.hpp>

#include "bench/report/subjects.hpp"

// The premise of the paper: with a single cylinder a crowd cannot be dense.

namespace bch::report {
namespace {

constexpr double loose = 0.4, shrinking = 0.99;    // people per square metre; of the area
constexpr float longest = 0.1f, beyond = 0.0005f;  // metres of a step
constexpr int max_steps = 300;
constexpr std::uint32_t least_people = 100;  // whose square repeats farther off than anybody reaches

class Packing {
 public:
  Packing(const ShapeSet& set, std::uint32_t people, std::uint64_t seed)
      : set_(set), crowd_(cli::place_crowd(people, loose, set.shape_count(), seed)) {}

  double density() const { return static_cast<double>(crowd_.size()) / (crowd_.side * crowd_.side); }

  void shrink() {
    const double times = std::sqrt(shrinking);
    crowd_.side *= times;
    for (std::vector<double>* places : {&crowd_.x, &crowd_.y})
      for (double& at : *places) at *= times;
  }

  /// Returns: whether no two people overlap in the end.
  bool settle() {
    bch::Crowd finder({.period = {crowd_.side, crowd_.side}});
    for (int i = 0; i < max_steps; ++i)
      if (!step(finder)) return true;
    return false;
  }

 private:
  /// Each of two goes half of the shortest separating move, but no more than a short step, so that those who reach around each
  /// other stop as soon as they can. Returns: whether somebody overlapped somebody.
  bool step(bch::Crowd& finder) {
    const auto [pairs, depths] = finder.penetrations(set_, crowd_.agents(), 32);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const double half = static_cast<double>(std::min(0.5f * depths[k].depth + beyond, longest));
      const double x = half * depths[k].x, y = half * depths[k].y;
      const auto [i, j] = pairs[k];
      crowd_.x[i] += x, crowd_.y[i] += y;
      crowd_.x[j] -= x, crowd_.y[j] -= y;
    }
    return !pairs.empty();
  }

  const ShapeSet& set_;
  cli::Crowd crowd_;
};

/// Measures how densely people can stand: so many of them, in poses and headings at random, on a square with
/// periodic boundaries (opposite sides are identified). They stand loosely at first and are pushed apart
/// until no two overlap. Then the square shrinks by a hundredth of its area, and so on
/// until they do not come apart in 300 steps.
/// Returns: people per square metre in the last square without overlaps, the same for the same arguments.
double densest_packing(const ShapeSet& set, std::uint32_t people, std::uint64_t seed) {
  Packing packing(set, people, seed);
  double densest = 0;
  while (packing.settle()) {
    densest = packing.density();
    packing.shrink();
  }
  return densest;
}

struct PackingRow {
  std::string name;
  ShapeSet set;
};

std::vector<PackingRow> rows_of(Run& run) {
  const std::span<const Shape> shapes = run.scene.shapes();
  std::vector<PackingRow> rows;
  const auto add_cut = [&](std::uint32_t depth) {
    rows.push_back({cut_name(depth), ShapeSet(shapes, {{depth}, true})});
  };
  add_cut(0);
  for (const float radius : {0.25f, 0.4f})
    rows.push_back({fmt::format("fixed cylinder {:.2f} m", radius),
                    ShapeSet(with_fixed_cylinders(shapes, radius), {{0}, true})});
  for (const std::uint32_t depth : {3u, 6u, 9u, all_depths}) add_cut(depth);
  return rows;
}

}  // namespace

void run_density(Run& run) {
  const std::vector<PackingRow> rows = rows_of(run);
  const std::size_t packings = run.sizes().packings;
  const std::uint32_t people = std::max(run.sizes().people, least_people);
  std::vector<double> densities(rows.size() * packings);
  tbb::parallel_for(
      std::size_t{0}, densities.size(),
      [&](std::size_t i) {
        densities[i] = densest_packing(rows[i / packings].set, people, run.seed() + i % packings);
      },
      tbb::simple_partitioner());
  Table table({"structure", "people", "packing", "densest (people/m2)"});
  for (std::size_t i = 0; i < densities.size(); ++i)
    table.add({rows[i / packings].name, people, i % packings, densities[i]});
  run.write("density", table);
}

}  // namespace bch::report
