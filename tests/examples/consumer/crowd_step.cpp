// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>
#include <vector>

#include <bch/characters.hpp>
#include <bch/crowd.hpp>
#include <bch/poses.hpp>

// A crowd step: people who stand in each other are pushed apart until nobody overlaps anybody. How closely they then
// stand is what hierarchies are for: the same crowd is stepped with its single cylinders and with its outlines' discs.

namespace {

struct Crowd {
  std::vector<std::uint32_t> shape;
  std::vector<double> x, y, heading;
  std::vector<std::uint8_t> level;

  bch::Agents agents() const { return {shape, x, y, heading, level}; }
};

/// So many people on a square that is much too small for them, at a level of detail.
Crowd crushed(std::uint32_t people, double per_square_metre, std::uint32_t shapes, std::uint8_t level) {
  std::mt19937_64 bits(2014);
  const auto uniform = [&](double high) { return high * (static_cast<double>(bits() >> 11) * 0x1p-53); };
  const double side = std::sqrt(people / per_square_metre);
  Crowd crowd;
  for (std::uint32_t i = 0; i < people; ++i) {
    crowd.shape.push_back(static_cast<std::uint32_t>(bits() % shapes));
    crowd.x.push_back(uniform(side));
    crowd.y.push_back(uniform(side));
    crowd.heading.push_back(uniform(6.28));
    crowd.level.push_back(level);
  }
  return crowd;
}

/// Moves each of two colliding agents half of the shortest way that penetration() finds, but by no more than a short
/// step, so that agents who reach around each other stop as soon as they do not overlap; and a little beyond, so that
/// rows of agents come to rest.
class Pusher {
 public:
  explicit Pusher(const bch::ShapeSet& shapes) : shapes_(shapes) {}

  /// Returns: how many pairs overlapped.
  std::size_t step(Crowd& crowd) {
    constexpr float longest = 0.1f, beyond = 0.001f;  // metres
    const bch::Crowd::Penetrations found = finder_.penetrations(shapes_, crowd.agents(), 32);
    for (std::size_t k = 0; k < found.pairs.size(); ++k) {
      const auto [depth, x, y] = found.penetrations[k];
      const double half = std::min(0.5f * depth + beyond, longest);
      const auto [i, j] = found.pairs[k];
      crowd.x[i] += half * x, crowd.y[i] += half * y;
      crowd.x[j] -= half * x, crowd.y[j] -= half * y;
    }
    return found.pairs.size();
  }

 private:
  const bch::ShapeSet& shapes_;
  bch::Crowd finder_;
};

/// People per square metre among the half of a crowd that is nearest its middle.
double density(const Crowd& crowd) {
  const std::size_t people = crowd.x.size();
  double x = 0, y = 0;
  for (std::size_t i = 0; i < people; ++i) x += crowd.x[i] / people, y += crowd.y[i] / people;
  std::vector<double> square;
  for (std::size_t i = 0; i < people; ++i)
    square.push_back((crowd.x[i] - x) * (crowd.x[i] - x) + (crowd.y[i] - y) * (crowd.y[i] - y));
  std::nth_element(square.begin(), square.begin() + people / 2, square.end());
  return (people / 2) / (3.14159265 * square[people / 2]);
}

/// Returns: the density at which no two people overlap; 0 where that is not reached.
double settle(const bch::ShapeSet& set, Crowd crowd, const char* name) {
  Pusher pusher(set);
  const std::size_t before = pusher.step(crowd);
  for (int iterations = 1; iterations < 2000; ++iterations) {
    if (pusher.step(crowd) > 0) continue;
    std::printf("%s: %zu overlapping pairs, none after %d iterations, then %.2f people per square metre\n",
                name, before, iterations, density(crowd));
    return density(crowd);
  }
  std::printf("%s: people still overlap\n", name);
  return 0;
}

}  // namespace

int main() {
  std::vector<bch::Shape> shapes;
  for (const bch::Character& character : {bch::default_male(), bch::default_female()}) {
    bch::PoseShaper shaper(character);
    for (const bch::PoseTime& time : bch::sample_poses(character, 50)) shapes.push_back(shaper.shape(time));
  }
  const bch::ShapeSet set(shapes, {.depths = {0, bch::all_depths}, .outlines = true});
  const auto crowd = [&](std::uint8_t level) { return crushed(300, 5, set.shape_count(), level); };
  const double cylinders = settle(set, crowd(0), "cylinders"),
               hierarchies = settle(set, crowd(1), "hierarchies");
  std::printf("density: %.2f times\n", hierarchies / cylinders);
  return cylinders > 0 && hierarchies > cylinders ? 0 : 1;
}
