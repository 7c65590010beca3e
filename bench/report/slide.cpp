// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/report/slide.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <bch/collide.hpp>
#include <bch/time_of_impact.hpp>

namespace bch::report {
namespace {

constexpr double step = 0.001, resolution = 1e-6;  // metres
constexpr double most_beside = 0.5;                // metres, of the paper
constexpr int most_draws = 100;
constexpr double not_detected = std::numeric_limits<double>::quiet_NaN();

/// A pair of agents that stands anywhere on the way.
struct PairOfCase {
  std::array<std::uint32_t, 2> shape;
  std::array<double, 2> x, y, heading;

  PairOfCase(const Agents& agents, Pair pair)
      : shape{agents.shape[pair.first], agents.shape[pair.second]},
        x{agents.x[pair.first], 0},
        y{agents.y[pair.first], agents.y[pair.second]},
        heading{agents.heading[pair.first], agents.heading[pair.second]} {}

  Agents at(double place) {
    x[0] = place;
    return {shape, x, y, heading};
  }
};

}  // namespace

SlideCases::SlideCases(std::span<const Shape> shapes, std::uint32_t cases, std::uint64_t seed) {
  detail::Random random(seed);
  const auto count = static_cast<std::uint32_t>(shapes.size());
  for (std::uint32_t i = 0; i < cases; ++i) {
    double reach = 0;
    for (int agent = 0; agent < 2; ++agent) {
      crowd_.shape.push_back(random.below(count));
      reach += shapes[crowd_.shape.back()].hierarchy.reach;
    }
    from_.push_back(-1.5 * reach - 0.1);
    crowd_.x.insert(crowd_.x.end(), {from_.back(), 0});
    pairs_.push_back({2 * i, 2 * i + 1});
  }
  crowd_.y.resize(2 * cases, 0), crowd_.heading.resize(2 * cases);
  for (std::size_t i = 0; i < cases; ++i) draw(random, i);
  const ShapeSet leaves(shapes);
  for (int drawn = 1, left = 1; left > 0 && drawn < most_draws; ++drawn) {
    const std::vector<double> places = contacts(leaves);
    left = 0;
    for (std::size_t i = 0; i < cases; ++i)
      if (std::isnan(places[i])) draw(random, i), ++left;
  }
}

void SlideCases::draw(detail::Random& random, std::size_t of) {
  crowd_.heading[2 * of] = random.uniform(2 * std::numbers::pi);
  crowd_.heading[2 * of + 1] = random.uniform(2 * std::numbers::pi);
  crowd_.y[2 * of] = random.uniform(2 * most_beside) - most_beside;
}

std::vector<double> SlideCases::contacts(const ShapeSet& set, Leaves leaves) const {
  // From one side to the other.
  std::vector<double> x(size()), y(size(), 0);
  for (std::size_t i = 0; i < size(); ++i) x[i] = -2 * from_[i];
  std::vector<float> times(size());
  time_of_impact(set, agents(), pairs_, {x, y}, times);
  std::vector<double> places(size(), not_detected);
  tbb::parallel_for(std::size_t{0}, size(), [&](std::size_t i) {
    if (std::isinf(times[i])) return;
    // No pair collides before discs touch.
    const double before = std::floor(static_cast<double>(times[i]) * x[i] / step) - 1;
    places[i] = contact(i, std::max(0.0, before), [&](const Agents& agents) {
      constexpr Pair both{0, 1};
      std::uint8_t hit = 0;
      collide(set, agents, {&both, 1}, {&hit, 1}, {.leaves = leaves});
      return hit != 0;
    });
  });
  return places;
}

std::vector<double> SlideCases::contacts(const baselines::Structure& structure,
                                         std::uint32_t max_depth) const {
  std::vector<double> places(size());
  tbb::parallel_for(std::size_t{0}, size(), [&](std::size_t i) {
    places[i] = contact(i, 0, [&](const Agents& agents) {
      return structure.query(agents, {0, 1}, max_depth);
    });
  });
  return places;
}

template <class Meet>
double SlideCases::contact(std::size_t of, double first_step, Meet meet) const {
  PairOfCase pair(agents(), pairs_[of]);
  const auto meet_at = [&](double place) { return meet(pair.at(place)); };
  for (double k = first_step;; ++k) {
    double place = from_[of] + k * step, apart = place - step;
    if (place >= -from_[of]) return not_detected;
    if (!meet_at(place)) continue;
    while (place - apart > resolution)
      (meet_at(0.5 * (apart + place)) ? place : apart) = 0.5 * (apart + place);
    return place;
  }
}

std::vector<double> SlideCases::distances(const baselines::PairDistances& bodies,
                                          std::span<const double> places) const {
  std::vector<double> centimetres(size(), not_detected);
  tbb::parallel_for(std::size_t{0}, size(), [&](std::size_t i) {
    if (std::isnan(places[i])) return;
    PairOfCase pair(agents(), pairs_[i]);
    centimetres[i] = 100 * std::max(0.0, bodies.query(pair.at(places[i]), {0, 1}));
  });
  return centimetres;
}

std::vector<double> known(std::span<const double> values) {
  std::vector<double> numbers;
  for (const double value : values)
    if (!std::isnan(value)) numbers.push_back(value);
  return numbers;
}

}  // namespace bch::report
