// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/stability/trial.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <bch/pairs.hpp>

namespace bch::bench {
namespace {

using detail::Random;

/// Agents 2 i and 2 i + 1 are pair i.
struct Batch {
  std::vector<std::uint32_t> shape;
  std::vector<double> x, y, heading, z;
  std::vector<Pair> pairs;

  void add(const PlacedSpecimen& placed, std::uint32_t index) {
    shape.push_back(index);
    x.push_back(placed.x), y.push_back(placed.y), heading.push_back(placed.heading);
    z.push_back(placed.z);
  }
  void add_pair() {
    const auto second = static_cast<std::uint32_t>(shape.size() - 1);
    pairs.push_back({second - 1, second});
  }
  std::vector<std::uint8_t> hits(const ShapeSet& set) const {
    std::vector<std::uint8_t> answers(pairs.size());
    Agents agents{shape, x, y, heading};
    if (set.has_heights()) agents.z = z;
    collide(set, agents, pairs, answers, {.leaves = Leaves::discs});
    return answers;
  }
};

/// Half of them a few units in the last place of a float, half of all magnitudes, either way.
double any_gap(Random& random, double radii, double max_extents) {
  if (random.below(2) == 0) return (static_cast<double>(random.below(129)) - 64) * float_step(radii);
  const double size = std::pow(10.0, -16 + random.uniform(15.5));
  return (random.below(2) == 0 ? size : -size) * max_extents;
}

/// The specimens that both agents come from, in one row of shapes.
struct Stock {
  std::vector<Specimen> specimens;
  std::uint32_t first =
      0;  ///< how many are for the first agent; the others, or else the same, for the second

  Stock(const StabilitySetup& setup, Random& random) : specimens(setup.make(random)) {
    first = static_cast<std::uint32_t>(specimens.size());
    if (!setup.make_other) return;
    std::vector<Specimen> others = setup.make_other(random);
    std::move(others.begin(), others.end(), std::back_inserter(specimens));
  }
  std::uint32_t one(Random& random) const { return random.below(first); }
  std::uint32_t other(Random& random) const {
    const auto all = static_cast<std::uint32_t>(specimens.size());
    return all == first ? random.below(first) : first + random.below(all - first);
  }
  /// The truth is about discs, so that bodies keep no outlines.
  ShapeSet set(ShapeSetPlan plan) const {
    plan.outlines = false;
    std::vector<Shape> shapes;
    for (const Specimen& specimen : specimens) shapes.push_back(specimen.shape);
    return ShapeSet(shapes, plan);
  }
};

class Runner {
 public:
  Runner(const StabilitySetup& setup, StabilityRow& row, std::uint64_t seed)
      : setup_(setup), row_(row), random_(seed), stock_(setup, random_), set_(stock_.set(setup.plan)) {}

  void run(std::uint32_t pairs) {
    if (setup_.outside) return query_outside();
    const bool outlines = setup_.placing == Placing::contact;
    const std::uint32_t to_outlines = outlines ? pairs / 2 : 0;
    for (std::uint32_t i = 0; i < pairs; ++i) add(i < to_outlines);
    const std::vector<std::uint8_t> hits = batch_.hits(set_);
    for (std::uint32_t i = 0; i < pairs; ++i)
      i < to_outlines ? count_outlines(i, hits[i] != 0) : count_discs(i, hits[i] != 0);
  }

 private:
  double heading() {
    return setup_.heading ? setup_.heading(random_) : random_.uniform(2 * std::numbers::pi);
  }
  double gap(double radii, double max_extents) {
    return setup_.gap ? setup_.gap(random_, radii, max_extents) : any_gap(random_, radii, max_extents);
  }

  /// Nothing is asked about what is true there.
  void query_outside() {
    for (int i = 0; i < 2; ++i)
      batch_.add({&stock_.specimens[0], setup_.x, setup_.y, heading(), setup_.z}, 0);
    batch_.add_pair();
    batch_.hits(set_);
  }

  Trial make_trial(std::uint32_t one, std::uint32_t other) {
    const double to = heading();
    const double by = setup_.placing == Placing::coincident && random_.below(2) == 0 ? to : heading();
    const PlacedSpecimen a{&stock_.specimens[one], setup_.x, setup_.y, to, setup_.z};
    return {a,
            {&stock_.specimens[other], setup_.x + setup_.apart_x, setup_.y + setup_.apart_y, by, setup_.z}};
  }

  void place(Trial& trial, bool outlines) {
    const double angle = random_.uniform(2 * std::numbers::pi), x = std::cos(angle), y = std::sin(angle);
    if (setup_.placing == Placing::coincident) {
      trial.b.x += (static_cast<double>(random_.below(3)) - 1) * double_step(setup_.x);
      trial.b.y += (static_cast<double>(random_.below(3)) - 1) * double_step(setup_.y);
    } else if (setup_.placing == Placing::stacked) {
      trial.put_on_top(gap(trial.max_extents() / 4, trial.max_extents()));
    } else if (setup_.placing == Placing::contact && outlines) {
      trial.store_outlines_in_contact(x, y, gap(trial.max_extents() / 4, trial.max_extents()));
    } else if (setup_.placing == Placing::contact) {
      trial.store_discs_in_contact(x, y, [&](double radii) { return gap(radii, trial.max_extents()); });
    }
  }

  void add(bool outlines) {
    const std::uint32_t one = stock_.one(random_);
    const std::uint32_t other = setup_.placing == Placing::coincident ? one : stock_.other(random_);
    Trial trial = make_trial(one, other);
    place(trial, outlines);
    batch_.add(trial.a, one);
    batch_.add(trial.b, other);
    batch_.add_pair();
    truths_.push_back(judge(trial, outlines));
  }

  /// What is kept of a trial.
  struct Truth {
    double gap, max_extents;
    bool outlines_meet, plain_float, plain_double;
  };
  static Truth judge(const Trial& trial, bool outlines) {
    if (outlines) return {0, 0, trial.outlines_meet(), false, false};
    return {trial.gap(), trial.max_extents(), false, trial.plain_float_hit(), trial.plain_double_hit()};
  }

  void count_outlines(std::uint32_t i, bool hit) {
    ++row_.outlines;
    row_.outlines_meeting += truths_[i].outlines_meet;
    row_.outline_misses += truths_[i].outlines_meet && !hit;
  }

  void count_discs(std::uint32_t i, bool hit) {
    const Truth& truth = truths_[i];
    ++row_.pairs;
    row_.meeting += truth.gap <= 0;
    count(row_.plain_float, truth, truth.plain_float);
    count(row_.plain_double, truth, truth.plain_double);
    count(row_.ours, truth, hit);
  }

  static void count(Errors& errors, const Truth& truth, bool hit) {
    if (truth.gap <= 0 && !hit) {
      ++errors.misses;
      errors.deepest_miss = std::max(errors.deepest_miss, -truth.gap);
      errors.miss_per_extent = std::max(errors.miss_per_extent, -truth.gap / truth.max_extents);
    } else if (truth.gap > 0 && hit) {
      ++errors.false_positives;
      errors.largest_gap = std::max(errors.largest_gap, truth.gap);
      errors.gap_per_extent = std::max(errors.gap_per_extent, truth.gap / truth.max_extents);
    }
  }

  const StabilitySetup& setup_;
  StabilityRow& row_;
  Random random_;
  Stock stock_;
  ShapeSet set_;
  Batch batch_;
  std::vector<Truth> truths_;
};

}  // namespace

double float_step(double value) {
  const float at = static_cast<float>(value);
  return static_cast<double>(std::nextafter(at, std::numeric_limits<float>::infinity())) -
         static_cast<double>(at);
}

double double_step(double value) {
  return std::nextafter(value, std::numeric_limits<double>::infinity()) - value;
}

StabilityRow run_setup(const char* family, const StabilitySetup& setup, std::uint32_t pairs,
                       std::uint64_t seed) {
  StabilityRow row;
  row.family = family, row.value = setup.value;
  row.conditioning = setup.conditioning, row.outside = setup.outside;
  try {
    Runner(setup, row, seed).run(std::max(20u, pairs / setup.cost));
  } catch (const std::invalid_argument& error) {
    row.refused = error.what();
  }
  return row;
}

}  // namespace bch::bench
