// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/report/subjects.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <bch/pairs.hpp>

namespace bch::report {
namespace {

constexpr double step = 0.001, resolution = 1e-6;  // metres
constexpr double max_offset = 0.5;                 // metres, of the paper
constexpr int max_draws = 100;
constexpr double not_detected = std::numeric_limits<double>::quiet_NaN();

/// A pair of agents that stands anywhere on the way.
struct PairOfCase {
  std::array<std::uint32_t, 2> shape;
  std::array<double, 2> x, y, heading;

  PairOfCase(const Agents& agents, std::size_t of)
      : shape{agents.shape[2 * of], agents.shape[2 * of + 1]},
        x{},
        y{agents.y[2 * of], agents.y[2 * of + 1]},
        heading{agents.heading.x()[2 * of], agents.heading.x()[2 * of + 1]} {}

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
    double max_extent = 0;
    for (int agent = 0; agent < 2; ++agent) {
      crowd_.shape.push_back(random.below(count));
      max_extent += shapes[crowd_.shape.back()].hierarchy.max_extent;
    }
    from_.push_back(-1.5 * max_extent - 0.1);
    crowd_.x.insert(crowd_.x.end(), {from_.back(), 0});
  }
  crowd_.y.resize(2 * cases, 0), crowd_.heading.resize(2 * cases);
  for (std::size_t i = 0; i < cases; ++i) draw(random, i);
  const ShapeSet leaves(shapes);
  for (int drawn = 1, left = 1; left > 0 && drawn < max_draws; ++drawn) {
    const std::vector<double> places = contacts([&](const Agents& agents, auto pairs, auto hits) {
      collide(leaves, agents, pairs, hits, {.leaves = Leaves::discs});
    });
    left = 0;
    for (std::size_t i = 0; i < cases; ++i)
      if (std::isnan(places[i])) draw(random, i), ++left;
  }
}

void SlideCases::draw(detail::Random& random, std::size_t of) {
  crowd_.heading[2 * of] = random.uniform(2 * std::numbers::pi);
  crowd_.heading[2 * of + 1] = random.uniform(2 * std::numbers::pi);
  crowd_.y[2 * of] = random.uniform(2 * max_offset) - max_offset;
}

std::vector<double> SlideCases::contacts(const Answer& answer) const {
  std::vector<double> places(size(), not_detected);
  tbb::parallel_for(std::size_t{0}, size(), [&](std::size_t i) {
    PairOfCase pair(agents(), i);
    const auto meet_at = [&](double place) {
      constexpr Pair both{0, 1};
      std::uint8_t hit = 0;
      answer(pair.at(place), {&both, 1}, {&hit, 1});
      return hit != 0;
    };
    double place = from_[i];
    for (double k = 1; place < -from_[i] && !meet_at(place); ++k) place = from_[i] + k * step;
    if (place >= -from_[i]) return;
    for (double apart = place - step; place - apart > resolution;)
      (meet_at(0.5 * (apart + place)) ? place : apart) = 0.5 * (apart + place);
    places[i] = place;
  });
  return places;
}

std::vector<double> SlideCases::distances(const baselines::PairDistances& bodies,
                                          std::span<const double> places) const {
  std::vector<double> centimetres(size(), not_detected);
  tbb::parallel_for(std::size_t{0}, size(), [&](std::size_t i) {
    if (std::isnan(places[i])) return;
    PairOfCase pair(agents(), i);
    centimetres[i] = 100 * std::max(0.0, bodies.query(pair.at(places[i]), {0, 1}));
  });
  return centimetres;
}

}  // namespace bch::report
