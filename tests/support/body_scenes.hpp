// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "tests/support/scenes.hpp"

namespace bch::test {

/// Makes a body of spheres in a column as tall as a person, or in a person's length on the ground.
inline std::vector<Sphere> random_body(Random& random, std::uint32_t spheres, bool lies = false) {
  const auto number = [&](double low, double high) { return static_cast<float>(random.between(low, high)); };
  std::vector<Sphere> body(spheres);
  for (Sphere& sphere : body) {
    sphere = {number(-0.25, 0.25), number(-0.2, 0.2), number(0, 1.8), number(0.02, 0.08)};
    if (lies) std::swap(sphere.x, sphere.z);
  }
  return body;
}

/// Makes bodies of few spheres and many.
inline BodySet random_bodies(Random& random) {
  std::vector<std::vector<Sphere>> bodies;
  for (const std::uint32_t spheres : {1u, 3u, 4u, 17u, 64u, 128u, 255u, 512u})
    bodies.push_back(random_body(random, spheres));
  return BodySet(bodies);
}

/// Makes bodies of standing and lying people, some of them off their origins, and far below, all as large by a factor.
inline BodySet bodies_of_all_kinds(Random& random, float scale = 1) {
  std::vector<std::vector<Sphere>> bodies;
  for (const std::uint32_t spheres : {1u, 2u, 5u, 16u, 63u, 128u, 256u, 385u})
    for (const bool lies : {false, true}) bodies.push_back(random_body(random, spheres, lies));
  for (const float up : {-2.0f, -0.7f, 0.3f})
    for (Sphere& sphere : bodies.emplace_back(random_body(random, 100))) sphere.z += up, sphere.x += 0.8f;
  for (auto& body : bodies)
    for (Sphere& s : body) s = {scale * s.x, scale * s.y, scale * s.z, scale * s.radius};
  return BodySet(bodies);
}

/// Holds a crowd in space.
struct BodyCrowd {
  std::vector<std::uint32_t> body;
  std::vector<double> x, y, z, heading;
  std::vector<Pair> pairs;

  Agents agents() const { return {.shape = body, .x = x, .y = y, .heading = heading, .z = z}; }
};

/// Makes a crowd of random placements on a square, at heights up to so much, and all of its pairs.
inline BodyCrowd random_body_crowd(Random& random, std::uint32_t agents, std::uint32_t bodies, double side,
                                   double height) {
  BodyCrowd crowd;
  for (std::uint32_t i = 0; i < agents; ++i) {
    crowd.body.push_back(random.below(bodies));
    crowd.x.push_back(random.between(0, side));
    crowd.y.push_back(random.between(0, side));
    crowd.z.push_back(random.between(0, height));
    crowd.heading.push_back(random.between(-4, 4));
    for (std::uint32_t j = 0; j < i; ++j) crowd.pairs.push_back({i, j});
  }
  return crowd;
}

/// Returns pairs whose agents are exchanged.
inline std::vector<Pair> exchanged(std::span<const Pair> pairs) {
  std::vector<Pair> all;
  for (const Pair pair : pairs) all.push_back({pair.second, pair.first});
  return all;
}

/// Represents a sphere of an agent where it stands, and where the agent does.
struct PlacedSphere {
  double x, y, z, radius;
  double agent_x, agent_y, agent_z;
};

/// Returns the spheres of all agents where these stand, in double.
inline std::vector<std::vector<PlacedSphere>> placed_spheres(std::span<const std::vector<Sphere>> bodies,
                                                             const BodyCrowd& crowd) {
  std::vector<std::vector<PlacedSphere>> placed(crowd.body.size());
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const double c = std::cos(crowd.heading[i]), s = std::sin(crowd.heading[i]);
    for (const Sphere& sphere : bodies[crowd.body[i]]) {
      const double x = double{sphere.x}, y = double{sphere.y};
      placed[i].push_back({crowd.x[i] + c * x - s * y, crowd.y[i] + s * x + c * y,
                           crowd.z[i] + double{sphere.z}, double{sphere.radius}, crowd.x[i], crowd.y[i],
                           crowd.z[i]});
    }
  }
  return placed;
}
inline std::vector<std::vector<PlacedSphere>> placed_spheres(const BodySet& bodies, const BodyCrowd& crowd) {
  std::vector<std::vector<Sphere>> all;
  for (std::uint32_t i = 0; i < bodies.body_count(); ++i) all.push_back(bodies.spheres(i));
  return placed_spheres(all, crowd);
}

/// Returns the gap between two spheres; below 0 where they overlap.
inline double gap(const PlacedSphere& a, const PlacedSphere& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z) - a.radius - b.radius;
}

/// Returns the least gap between two spheres of two bodies.
inline double gap(std::span<const PlacedSphere> a, std::span<const PlacedSphere> b) {
  double least = std::numeric_limits<double>::infinity();
  for (const PlacedSphere& p : a)
    for (const PlacedSphere& q : b) least = std::min(least, gap(p, q));
  return least;
}

}  // namespace bch::test
