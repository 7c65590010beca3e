// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

// The simulator of the tutorial in kernel/README.md, which shows its parts.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>
#include <vector>

#include <bch/bch.hpp>

// [simulator]
struct People {
  std::vector<std::uint32_t> shape;   // which body each person has now
  std::vector<double> x, y, heading;  // metres, radians; on a corridor of 20 x 6 m that is periodic in x
  std::vector<std::uint8_t> level;    // how exactly each is checked

  bch::Agents agents() const { return {shape, x, y, heading, level}; }

  void walk(double seconds) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] += 1.3 * seconds * std::cos(heading[i]);
      x[i] -= 20 * std::floor(x[i] / 20);
    }
  }
};
// [simulator]

People two_streams(std::uint32_t count, std::uint32_t shapes) {
  People people;
  std::mt19937_64 random(7);
  const auto uniform = [&](double length) { return length * static_cast<double>(random() >> 11) * 0x1p-53; };
  for (std::uint32_t i = 0; i < count; ++i) {
    people.shape.push_back(static_cast<std::uint32_t>(random() % shapes));
    people.x.push_back(uniform(20)), people.y.push_back(0.5 + uniform(5));
    people.heading.push_back(i % 2 == 0 ? 0 : 3.14159265);
  }
  people.level.assign(count, 1);
  return people;
}

// [separation]
/// Separates people who collide, each by half of the depth but at most 10 cm, and moves people out of walls.
void separate(People& people, bch::Crowd& crowd, const bch::ShapeSet& bodies, const bch::ObstacleSet& walls) {
  const bch::Crowd::Penetrations found = crowd.penetrations(bodies, people.agents());
  for (std::size_t k = 0; k < found.pairs.size(); ++k) {
    const auto [depth, x, y] = found.penetrations[k];
    const auto [a, b] = found.pairs[k];
    const double shift = std::fmin(0.5 * depth, 0.1);
    people.x[a] += shift * x, people.y[a] += shift * y;
    people.x[b] -= shift * x, people.y[b] -= shift * y;
  }
  std::vector<bch::Penetration> out(people.x.size());
  bch::penetration(bodies, people.agents(), walls, out);
  for (std::size_t i = 0; i < out.size(); ++i)
    people.x[i] += out[i].depth * out[i].x, people.y[i] += out[i].depth * out[i].y;
}
// [separation]

int main() {
  // [bodies]
  const bch::Character characters[] = {bch::default_male(), bch::default_female()};
  const bch::ShapeSet bodies = bch::bake(characters, {.poses = 50, .plan = {.depths = {0, bch::all_depths}}});
  // [bodies]
  People people = two_streams(60, bodies.shape_count());

  // [collisions]
  bch::Crowd crowd({.period = {.x = 20}});
  const std::size_t at_first = crowd.collisions(bodies, people.agents()).size();
  // [collisions]
  std::printf("%zu pairs collide at first\n", at_first);

  // [walls]
  const bch::ObstacleSet walls = bch::obstacles_from_wkt("LINESTRING (-1 0, 21 0) LINESTRING (-1 6, 21 6)");
  std::vector<std::uint8_t> in_wall(people.x.size());
  bch::collide(bodies, people.agents(), walls, in_wall);
  // [walls]

  // [levels]
  for (std::size_t i = 0; i < people.x.size(); ++i) people.level[i] = people.x[i] < 10 ? 1 : 0;
  // [levels]

  for (int step = 0; step < 200; ++step) {
    people.walk(0.05);
    separate(people, crowd, bodies, walls);
  }
  int sweeps = 0;
  for (; sweeps < 100 && !crowd.collisions(bodies, people.agents()).empty(); ++sweeps)
    separate(people, crowd, bodies, walls);
  std::printf("after 10 s of walking, %d more sweeps separate everybody\n", sweeps);
  return sweeps < 100 ? 0 : 1;
}
