// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include <bch/crowd.hpp>
#include <bch/pairs.hpp>
#include <bch/scene_plan.hpp>

#include "bench/report/subjects.hpp"
#include "layout/base/random.hpp"

// The premise of the paper: with a single cylinder a crowd cannot be dense.

namespace bch::report {
namespace {

/// Selects what people in a crush may change beside their places.
enum class Freedom : std::uint8_t {
  places,    ///< nothing else
  headings,  ///< they turn, a few degrees a step, where that leaves less overlap
  poses,     ///< they also take another pose of the same character, drawn at random, where that does
};

constexpr double loose = 0.4, shrinking = 0.99;    // people per square metre; of the area
constexpr double margin = 1.6;                     // metres: as far as two people reach at each other
constexpr float longest = 0.1f, beyond = 0.0005f;  // metres of a step
constexpr int most_steps = 300;
constexpr double turn = 0.05;  // radians of a step

class Packing {
 public:
  Packing(const ShapeSet& set, std::uint32_t people, std::uint64_t seed, Freedom freedom, std::uint32_t poses)
      : set_(set),
        people_(people),
        freedom_(freedom),
        poses_(poses),
        random_(seed),
        crowd_(cli::place_crowd(people, loose, set.shape_count(), seed)) {}

  double density() const { return people_ / (crowd_.side * crowd_.side); }

  void shrink() {
    const double times = std::sqrt(shrinking);
    crowd_.side *= times;
    for (std::uint32_t i = 0; i < people_; ++i) crowd_.x[i] *= times, crowd_.y[i] *= times;
  }

  /// Returns: whether no two people overlap in the end.
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
    const CrowdPairs found = finder_.collisions(set_, crowd_.agents());
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
    if (freedom_ != Freedom::places) change_stances();
    remove_images();
    return !pairs_.empty();
  }

  /// A way for an agent to stand where he is.
  struct Stance {
    std::uint32_t shape;
    double heading;
  };

  /// Returns the stances that a person may take: the present one, turned either way, and, where poses are
  /// free, in another pose.
  std::vector<Stance> stances(std::uint32_t of) {
    const std::uint32_t shape = crowd_.shape[of];
    const double heading = crowd_.heading[of];
    std::vector<Stance> all = {{shape, heading}, {shape, heading + turn}, {shape, heading - turn}};
    if (freedom_ == Freedom::poses) all.push_back({shape / poses_ * poses_ + random_.below(poses_), heading});
    return all;
  }

  /// Everybody who overlaps somebody takes the stance that would leave the least overlap if all others kept theirs.
  void change_stances() {
    std::vector<std::vector<std::uint32_t>> beside(people_);
    for (const auto [i, j] : pairs_) {
      if (i < people_) beside[i].push_back(j);
      if (j < people_) beside[j].push_back(i);
    }
    cli::Crowd trial = crowd_;
    std::vector<Pair> asked;
    std::vector<std::pair<std::uint32_t, Stance>> offers;  // of asked pairs, to whom
    for (std::uint32_t i = 0; i < people_; ++i) {
      if (beside[i].empty()) continue;
      for (const Stance& stance : stances(i)) {
        const auto agent = static_cast<std::uint32_t>(trial.size());
        trial.shape.push_back(stance.shape), trial.heading.push_back(stance.heading);
        trial.x.push_back(crowd_.x[i]), trial.y.push_back(crowd_.y[i]);
        offers.push_back({i, stance});
        for (const std::uint32_t j : beside[i]) asked.push_back({agent, j});
      }
    }
    take_best(trial, asked, offers);
  }

  void take_best(const cli::Crowd& trial, std::span<const Pair> asked,
                 std::span<const std::pair<std::uint32_t, Stance>> offers) {
    const auto first_trial = static_cast<std::uint32_t>(crowd_.size());
    std::vector<Penetration> ways(asked.size());
    std::vector<std::uint8_t> hits(asked.size());
    penetration(set_, trial.agents(), asked, 16, ways);
    collide(set_, trial.agents(), asked, hits);
    std::vector<double> overlap(offers.size(), 0);
    for (std::size_t k = 0; k < asked.size(); ++k)
      overlap[asked[k].first - first_trial] += hits[k] != 0 ? static_cast<double>(ways[k].depth) : 0;
    std::vector<double> least(people_, HUGE_VAL);
    for (std::size_t k = 0; k < offers.size(); ++k) {
      const auto& [agent, stance] = offers[k];
      if (!(overlap[k] < least[agent])) continue;
      least[agent] = overlap[k];
      crowd_.shape[agent] = stance.shape, crowd_.heading[agent] = stance.heading;
    }
  }

  const ShapeSet& set_;
  std::uint32_t people_;
  Freedom freedom_;
  std::uint32_t poses_;
  detail::Random random_;
  cli::Crowd crowd_;
  bch::Crowd finder_;
  std::vector<Pair> pairs_;
  std::vector<Penetration> ways_;
};

/// Measures how densely people can stand: so many of them, in poses and headings at random, on a square with
/// periodic boundaries (opposite sides are identified). They stand loosely at first and are pushed apart
/// until no two overlap. Then the square shrinks by a hundredth of its area, and so on
/// until they do not come apart in 300 steps.
/// `poses`: how many shapes of the set, one after the other, belong to a character each; used by
/// Freedom::poses alone.
/// Returns: people per square metre in the last square without overlaps, the same for the same arguments.
double densest_packing(const ShapeSet& set, std::uint32_t people, std::uint64_t seed, Freedom freedom,
                       std::uint32_t poses) {
  Packing packing(set, people, seed, freedom, poses);
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
  Freedom freedom = Freedom::places;
};

constexpr std::uint32_t most_free_people = 300;  // each of whom tries several stances a step
constexpr const char* freedom_names[] = {"places", "headings", "headings and poses"};

std::vector<PackingRow> rows_of(Run& run) {
  const std::span<const Shape> shapes = run.scene.shapes();
  std::vector<PackingRow> rows;
  const auto add_cut = [&](std::uint32_t depth, Freedom freedom = Freedom::places) {
    rows.push_back({cut_name(depth), ShapeSet(shapes, {{depth}, true}), freedom});
  };
  add_cut(0);
  for (const float radius : {0.25f, 0.4f})
    rows.push_back({fmt::format("fixed cylinder {:.2f} m", radius),
                    ShapeSet(with_fixed_cylinders(shapes, radius), {{0}, true})});
  for (const std::uint32_t depth : {3u, 6u, 9u, all_depths}) add_cut(depth);
  for (const Freedom freedom : {Freedom::headings, Freedom::poses})
    for (const std::uint32_t depth : {0u, 3u, all_depths}) add_cut(depth, freedom);
  return rows;
}

}  // namespace

void run_density(Run& run) {
  const std::vector<PackingRow> rows = rows_of(run);
  const std::size_t packings = run.sizes().packings;
  const auto people_of = [&](const PackingRow& row) {
    return row.freedom == Freedom::places ? run.sizes().people
                                          : std::min(run.sizes().people, most_free_people);
  };
  // Characters without clips have one pose, which then never changes.
  const std::size_t posed = run.scene.characters().size() * run.sizes().poses;
  const std::uint32_t free_poses = run.scene.shapes().size() == posed ? run.sizes().poses : 1;
  std::vector<double> densities(rows.size() * packings);
  tbb::parallel_for(
      std::size_t{0}, densities.size(),
      [&](std::size_t i) {
        const PackingRow& row = rows[i / packings];
        densities[i] =
            densest_packing(row.set, people_of(row), run.seed() + i % packings, row.freedom, free_poses);
      },
      tbb::simple_partitioner());
  Table table({"structure", "free", "people", "packing", "densest (people/m2)"});
  for (std::size_t i = 0; i < densities.size(); ++i) {
    const PackingRow& row = rows[i / packings];
    table.add({row.name, freedom_names[static_cast<std::size_t>(row.freedom)], people_of(row), i % packings,
               densities[i]});
  }
  run.write("density", table);
}

}  // namespace bch::report
