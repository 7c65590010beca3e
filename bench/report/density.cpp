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
constexpr double margin = 1.6;                     // metres: as far as two people reach at each other
constexpr float longest = 0.1f, beyond = 0.0005f;  // metres of a step
constexpr int max_steps = 300;

class Packing {
 public:
  Packing(const ShapeSet& set, std::uint32_t people, std::uint64_t seed)
      : set_(set), people_(people), crowd_(cli::place_crowd(people, loose, set.shape_count(), seed)) {}

  double density() const { return people_ / (crowd_.side * crowd_.side); }

  void shrink() {
    const double times = std::sqrt(shrinking);
    crowd_.side *= times;
    for (std::uint32_t i = 0; i < people_; ++i) crowd_.x[i] *= times, crowd_.y[i] *= times;
  }

  /// Returns: whether no two people overlap in the end.
  bool settle() {
    for (int i = 0; i < max_steps; ++i)
      if (!step()) return true;
    return false;
  }

 private:
  /// Copies of those near a side, beyond the other one.
  void add_images() {
    for (std::uint32_t i = 0; i < people_; ++i)
      for (int across = -1; across <= 1; ++across)
        for (int along = -1; along <= 1; ++along)
          if (across != 0 || along != 0) add_image(i, across * crowd_.side, along * crowd_.side);
  }

  void add_image(std::uint32_t of, double x, double y) {
    const auto near = [&](double at) { return at >= -margin && at < crowd_.side + margin; };
    if (!near(crowd_.x[of] + x) || !near(crowd_.y[of] + y)) return;
    crowd_.shape.push_back(crowd_.shape[of]);
    crowd_.x.push_back(crowd_.x[of] + x);
    crowd_.y.push_back(crowd_.y[of] + y);
    crowd_.heading.push_back(crowd_.heading[of]);
  }

  void remove_images() {
    crowd_.shape.resize(people_), crowd_.heading.resize(people_);
    crowd_.x.resize(people_), crowd_.y.resize(people_);
    for (std::uint32_t i = 0; i < people_; ++i) {
      crowd_.x[i] -= crowd_.side * std::floor(crowd_.x[i] / crowd_.side);
      crowd_.y[i] -= crowd_.side * std::floor(crowd_.y[i] / crowd_.side);
    }
  }

  /// Who collides, each pair once; of a pair across a side, both ways, and each moves the one that is no image.
  void find_pairs() {
    const bch::Crowd::Pairs found = finder_.collisions(set_, crowd_.agents());
    pairs_.clear();
    for (const Pair& pair : found)
      if (pair.first < people_) pairs_.push_back(pair);
  }

  /// Each of two goes half of the shortest way apart, but no more than a short step, so that those who reach around each
  /// other stop as soon as they can. Returns: whether somebody overlapped somebody.
  bool step() {
    add_images();
    find_pairs();
    ways_.resize(pairs_.size());
    penetration(set_, crowd_.agents(), pairs_, 32, ways_);
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const double half = static_cast<double>(std::min(0.5f * ways_[k].depth + beyond, longest));
      const double x = half * ways_[k].x, y = half * ways_[k].y;
      const auto [i, j] = pairs_[k];
      crowd_.x[i] += x, crowd_.y[i] += y;
      crowd_.x[j] -= x, crowd_.y[j] -= y;  // an image's is forgotten
    }
    remove_images();
    return !pairs_.empty();
  }

  const ShapeSet& set_;
  std::uint32_t people_;
  cli::Crowd crowd_;
  bch::Crowd finder_;
  std::vector<Pair> pairs_;
  std::vector<Penetration> ways_;
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
  std::vector<double> densities(rows.size() * packings);
  tbb::parallel_for(
      std::size_t{0}, densities.size(),
      [&](std::size_t i) {
        densities[i] = densest_packing(rows[i / packings].set, run.sizes().people, run.seed() + i % packings);
      },
      tbb::simple_partitioner());
  Table table({"structure", "people", "packing", "densest (people/m2)"});
  for (std::size_t i = 0; i < densities.size(); ++i)
    table.add({rows[i / packings].name, run.sizes().people, i % packings, densities[i]});
  run.write("density", table);
}

}  // namespace bch::report
