// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <random>
#include <set>
#include <vector>

#include <bch/characters.hpp>
#include <bch/crowd.hpp>
#include <bch/pairs.hpp>
#include <bch/poses.hpp>

// Continuous motion: two groups of people walk towards each other in steps of half a second. time_of_impact() stops who
// would touch somebody on the way, and so nobody walks through anybody.

namespace {

constexpr double step_length = 0.65;  // metres
constexpr int steps = 60;

struct Walkers {
  std::vector<std::uint32_t> shape;
  std::vector<double> x, y, heading;
  std::vector<double> to_x, to_y;  ///< the next step's way

  std::size_t size() const { return x.size(); }
  bch::Agents agents() const { return {shape, x, y, heading}; }

  /// Where they are after a part of the step.
  Walkers after(double part) const {
    Walkers moved = *this;
    for (std::size_t i = 0; i < size(); ++i) moved.x[i] += part * to_x[i], moved.y[i] += part * to_y[i];
    return moved;
  }
};

/// Two groups that face each other, nobody in reach of anybody.
Walkers two_groups(std::uint32_t shapes, std::mt19937_64& random) {
  constexpr double apart = 1.6;
  Walkers walkers;
  for (int group = -1; group <= 1; group += 2)
    for (int row = 0; row < 8; ++row)
      for (int column = 0; column < 8; ++column) {
        walkers.shape.push_back(static_cast<std::uint32_t>(random() % shapes));
        walkers.x.push_back(group * (2 + apart * column));
        walkers.y.push_back(apart * (row + 0.2 * group));
        walkers.heading.push_back(group < 0 ? 0 : std::numbers::pi);
      }
  walkers.to_x = walkers.to_y = std::vector<double>(walkers.size());
  return walkers;
}

/// Straight on; who was stopped tries his luck to a side.
void aim(Walkers& walkers, const std::vector<double>& last_part, std::mt19937_64& random) {
  for (std::size_t i = 0; i < walkers.size(); ++i) {
    const double side = static_cast<double>(random() >> 11) * 0x1p-52 - 1;
    const double angle = walkers.heading[i] + (last_part[i] < 0.5 ? 1.4 * side : 0);
    walkers.to_x[i] = step_length * std::cos(angle), walkers.to_y[i] = step_length * std::sin(angle);
  }
}

/// Who would touch somebody stops a little before. That may bring him into the way of others: until nobody touches
/// anybody.
/// Returns: the part of the way that each goes.
std::vector<double> shorten(const bch::ShapeSet& shapes, std::span<const bch::Pair> near, Walkers& walkers) {
  const Walkers free = walkers;
  std::vector<double> part(walkers.size(), 1), x(near.size()), y(near.size());
  std::vector<float> time(near.size());
  for (bool again = true; again;) {
    again = false;
    for (std::size_t k = 0; k < near.size(); ++k) {
      const auto [i, j] = near[k];
      x[k] = walkers.to_x[i] - walkers.to_x[j], y[k] = walkers.to_y[i] - walkers.to_y[j];
    }
    bch::time_of_impact(shapes, walkers.agents(), near, {x, y}, time);
    const std::vector<double> before = part;
    for (std::size_t k = 0; k < near.size(); ++k) {
      if (!(time[k] <= 1)) continue;
      again = true;
      for (const std::uint32_t who : {near[k].first, near[k].second}) {
        const double shorter = 0.99 * static_cast<double>(time[k]) * before[who];
        part[who] = std::min(part[who], shorter < 0.01 ? 0 : shorter);
        walkers.to_x[who] = part[who] * free.to_x[who], walkers.to_y[who] = part[who] * free.to_y[who];
      }
    }
  }
  return part;
}

/// Pairs that overlap somewhere on the way, looked at every centimetre.
std::size_t overlaps(const bch::ShapeSet& shapes, std::span<const bch::Pair> near, const Walkers& walkers) {
  std::vector<std::uint8_t> hits(near.size());
  std::set<std::size_t> met;
  for (double part = 0; part <= 1; part += 0.01 / step_length) {
    bch::collide(shapes, walkers.after(part).agents(), near, hits);
    for (std::size_t k = 0; k < near.size(); ++k)
      if (hits[k]) met.insert(k);
  }
  return met.size();
}

}  // namespace

int main() {
  std::vector<bch::Shape> shapes;
  for (const bch::Character& character : {bch::default_male(), bch::default_female()}) {
    bch::ShapeBuilder shape_builder(character);
    for (const bch::PoseTime& time : bch::sample_poses(character, 50))
      shapes.push_back(shape_builder.shape(time));
  }
  const bch::ShapeSet set(shapes);
  std::mt19937_64 random(2014);
  Walkers walkers = two_groups(set.shape_count(), random);
  const Walkers start = walkers;
  bch::Crowd crowd;
  std::vector<double> part(walkers.size(), 1);
  std::size_t avoided = 0, met = 0;
  for (int i = 0; i < steps; ++i) {
    aim(walkers, part, random);
    // All pairs that may meet within a step, in which either goes a step's length at most.
    const std::span<const bch::Pair> near = crowd.candidates(set, walkers.agents(), 2 * step_length).span();
    avoided += overlaps(set, near, walkers);
    part = shorten(set, near, walkers);
    met += overlaps(set, near, walkers);
    walkers = walkers.after(1);
  }
  double way = 0;
  for (std::size_t i = 0; i < walkers.size(); ++i)
    way += std::abs(walkers.x[i] - start.x[i]) / walkers.size();
  std::printf("%zu people in %d steps, %.1f m on: stopped %zu times, %zu times one through another\n",
              walkers.size(), steps, way, avoided, met);
  return way > 5 && avoided > 0 && met == 0 ? 0 : 1;
}
