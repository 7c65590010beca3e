// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/report/packing.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "bench/crowd.hpp"
#include "kernel/collide_all.hpp"
#include "kernel/separation.hpp"

namespace bch::report {
namespace {

constexpr double loose = 0.4, shrinking = 0.99;    // people per square metre; of the area
constexpr double margin = 1.6;                     // metres: as far as two people reach at each other
constexpr float longest = 0.1f, beyond = 0.0005f;  // metres of a step
constexpr int most_steps = 300;

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

  /// Returns: whether nobody overlaps anybody in the end.
  bool settle() {
    for (int i = 0; i < most_steps; ++i)
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
    const CollidingNeighbours rows = collider_.collide_all(set_, crowd_.agents(), {Semantics::solid});
    pairs_.clear();
    for (std::uint32_t i = 0; i < people_; ++i)
      for (const std::uint32_t j : rows.of(i))
        if (i < j) pairs_.push_back({i, j});
  }

  /// Each of two goes half of the shortest way apart, but no more than a short step, so that those who reach around each
  /// other stop as soon as they can. Returns: whether somebody overlapped somebody.
  bool step() {
    add_images();
    find_pairs();
    ways_.resize(pairs_.size());
    separation(set_, crowd_.agents(), pairs_, 32, ways_);
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
  CrowdCollider collider_;
  std::vector<Pair> pairs_;
  std::vector<Separation> ways_;
};

}  // namespace

double densest_packing(const ShapeSet& set, std::uint32_t people, std::uint64_t seed) {
  Packing packing(set, people, seed);
  double densest = 0;
  while (packing.settle()) {
    densest = packing.density();
    packing.shrink();
  }
  return densest;
}

}  // namespace bch::report
