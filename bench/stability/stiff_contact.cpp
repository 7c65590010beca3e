// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include <bch/characters.hpp>
#include <bch/crowd.hpp>
#include <bch/pairs.hpp>
#include <bch/poses.hpp>

#include "bench/base/text.hpp"
#include "bench/stability/stability.hpp"
#include "bench/stability/trial.hpp"

// Depths as the springs of penalty forces: a stiff use, which fails with a depth that jumps. Where two agents have a depth, a
// force k depth acts along its direction, and a friction kappa depth times the sliding speed across it. Headings stay.
// Source:  D. Helbing, I. Farkas, T. Vicsek, "Simulating dynamical features of escape panic", Nature 407, 2000, for the
//          constants; without the repulsion at a distance. Steps are those of semi-implicit Euler.

namespace bch::bench {
namespace {

using detail::Random;
using std::numbers::pi;
using Plane = std::complex<double>;
using Goal = Plane (*)(Plane at);  ///< where somebody wants to go, a unit vector

constexpr std::uint32_t cuts[] = {0, 3, 6, all_depths};
constexpr std::uint32_t people_shapes = 8, wall = people_shapes;  // a wall of 10 m
constexpr double mass = 80, stiffness = 1.2e5, friction = 2.4e5;  // kg, kg/s^2, kg/(m s)
constexpr double wanted_speed = 1, relaxation = 0.5;              // m/s, s
constexpr int tried_ms[] = {2, 3, 4, 6, 8, 10, 12, 16, 20, 24, 28, 32, 36, 40, 48};

/// The depths that are compared: penetration() by the best of 32 directions, nearest_free() by the best of `free_directions`, and the
/// overlap of the two discs of the cuts that overlap deepest.
enum class Law : std::uint8_t { penetration, nearest_free, deepest_discs };
constexpr const char* law_names[] = {"penetration", "nearest free", "deepest discs"};
constexpr std::uint32_t free_directions = 64;

ShapeSet make_shapes() {
  std::vector<Shape> all;
  for (const Character& character : {default_male(), default_female()}) {
    ShapeBuilder shape_builder(character);
    for (const PoseTime& time : sample_poses(character, people_shapes / 2))
      all.push_back(shape_builder.shape(time));
  }
  all.push_back(raw_specimen({{-5, -0.2f}, {5, -0.2f}, {5, 0.2f}, {-5, 0.2f}}, 0.02).shape);
  return ShapeSet(all, {.depths = {std::begin(cuts), std::end(cuts)}});
}

/// Simulates agents and the forces that move them; walls stay.
struct World {
  const ShapeSet& shapes;
  Law law;
  std::uint8_t level;
  std::vector<std::uint32_t> shape = {};
  std::vector<std::uint8_t> levels = {};
  std::vector<double> x = {}, y = {}, heading = {};
  std::vector<Plane> velocity = {};
  double deepest = 0;  ///< metres, in the last step

  void add(std::uint32_t of, Plane at, double turned, Plane flying = 0) {
    shape.push_back(of), levels.push_back(of == wall ? std::size(cuts) - 1 : level);
    x.push_back(at.real()), y.push_back(at.imag()), heading.push_back(turned), velocity.push_back(flying);
  }
  void add_person(Plane at, double turned, Random& random, Plane flying = 0) {
    add(random.below(people_shapes), at, turned, flying);
  }

  /// Returns the forces by which agents push each other, with or without friction.
  std::vector<Plane> push(bool rubs) {
    const Agents agents{shape, x, y, heading, levels};
    Crowd finder;
    // Discs of cuts may overlap where root discs do not. Any margin makes the candidates know that.
    const bool discs = law == Law::deepest_discs;
    const auto pairs =
        discs ? finder.candidates(shapes, agents, 1e-3).span() : finder.collisions(shapes, agents).span();
    std::vector<Penetration> found(pairs.size());
    std::vector<float> distance(pairs.size());
    std::vector<Vec2> towards(pairs.size());
    if (discs)
      clearance(shapes, agents, pairs, {distance, towards}, {.max_distance = 0, .overlap = Overlap::deepest});
    else if (law == Law::nearest_free)
      nearest_free(shapes, agents, pairs, free_directions, found);
    else
      penetration(shapes, agents, pairs, 32, found);
    std::vector<Plane> force(shape.size());
    deepest = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto [a, b] = pairs[i];
      const Plane away = discs ? -Plane(towards[i].x, towards[i].y) : Plane(found[i].x, found[i].y);
      const double depth = discs ? std::max(-distance[i], 0.0f) : found[i].depth;
      const double sliding = rubs ? (std::conj(away) * (velocity[b] - velocity[a])).imag() : 0;
      const Plane one = depth * away * Plane(stiffness, friction * sliding);
      force[a] += one, force[b] -= one;
      deepest = std::max(deepest, depth);
    }
    return force;
  }

  /// Without a goal: without drive and friction.
  void step(double seconds, Goal goal) {
    const std::vector<Plane> force = push(goal != nullptr);
    for (std::size_t i = 0; i < shape.size(); ++i) {
      if (shape[i] == wall) continue;
      const Plane pull = goal ? (wanted_speed * goal({x[i], y[i]}) - velocity[i]) / relaxation : 0;
      velocity[i] += seconds * (force[i] / mass + pull);
      x[i] += seconds * velocity[i].real(), y[i] += seconds * velocity[i].imag();
    }
  }
};

/// Returns the largest step with which nobody becomes faster than twice the wanted speed once the first second is over.
double largest_stable_step(const World& begin, Goal goal, double seconds) {
  double largest = 0;
  for (const int ms : tried_ms) {
    const double step = ms / 1000.0;
    World world = begin;
    for (double time = 0; time < seconds; time += step) {
      world.step(step, goal);
      for (const Plane v : world.velocity)
        if (time > 1 && !(std::abs(v) <= 2 * wanted_speed)) return largest;
    }
    largest = step;
  }
  return largest;
}

void press(StiffRow& row, const World& empty, std::uint32_t people) {
  World two = empty, file = empty, door = empty;
  Random of_two(7), of_file(7), of_door(7);
  two.add_person({-0.5, 0.02}, 0.1, of_two);
  two.add_person({0.5, -0.02}, pi - 0.2, of_two);
  // Towards the middle, so that there is a place of rest.
  row.two_step = largest_stable_step(
      two, [](Plane at) { return -at / std::abs(at); }, 4);
  for (std::uint32_t i = 0; i < std::min(people, 20u); ++i)
    file.add_person(-0.6 - 0.8 * i, of_file.between(-0.3, 0.3), of_file);
  file.add(wall, 0.2, pi / 2);
  for (const double from : {-5.0, -15.0}) file.add(wall, {from, -0.7}, 0), file.add(wall, {from, 0.7}, 0);
  row.row_step = largest_stable_step(
      file, [](Plane) { return Plane(1); }, 12);  // until the last one arrives
  for (std::uint32_t i = 0; i < people; ++i)
    door.add_person({-0.8 - 0.9 * (i / 14), 0.9 * (i % 14) - 5.85}, of_door.between(-0.5, 0.5), of_door);
  for (const double y : {5.6, -5.6}) door.add(wall, {0.2, y}, pi / 2);
  const Goal through = [](Plane at) { return at.real() < 0.1 ? (0.2 - at) / std::abs(0.2 - at) : Plane(1); };
  row.door_step = largest_stable_step(door, through, 4);
}

void bounce(StiffRow& row, World world, Random& random) {
  const double aside = random.between(-0.15, 0.15);
  for (const double side : {-1.0, 1.0})
    world.add_person(side * Plane(0.7, -aside), random.uniform(2 * pi), random, -0.5 * side);
  double onset = 0;
  for (int i = 0, apart = 0; i < 10'000 && apart < 500; ++i) {
    world.step(1e-3, nullptr);
    if (onset == 0) onset = world.deepest;
    if (onset == 0 && i > 1500) return;  // they pass
    apart = onset == 0 || world.deepest > 0 ? 0 : apart + 1;
  }
  const double energy = (std::norm(world.velocity[0]) + std::norm(world.velocity[1])) / 0.5 - 1;
  ++row.bounces, row.onset += onset, row.energy += std::abs(energy);
  row.largest_onset = std::max(row.largest_onset, onset);
  row.max_energy = std::max(row.max_energy, energy);
}

}  // namespace

std::vector<StiffRow> stiff_rows(std::uint32_t people, std::uint32_t bounces) {
  const ShapeSet shapes = make_shapes();
  std::vector<StiffRow> rows(std::size(law_names) * std::size(cuts));
  tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t i) {
    const World empty{shapes, static_cast<Law>(i / std::size(cuts)),
                      static_cast<std::uint8_t>(i % std::size(cuts))};
    StiffRow& row = rows[i];
    row.law = law_names[i / std::size(cuts)], row.cut = cli::depth_name(cuts[empty.level]);
    press(row, empty, people);
    Random random(11);
    for (std::uint32_t k = 0; k < bounces; ++k) bounce(row, empty, random);
    row.onset /= row.bounces, row.energy /= row.bounces;
  });
  return rows;
}

}  // namespace bch::bench
