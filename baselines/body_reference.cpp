// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/body_reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "baselines/placement.hpp"

namespace bch::baselines {
namespace {

float square_between(const Sphere& a, const Sphere& b) {
  const float x = b.x - a.x, y = b.y - a.y, z = b.z - a.z;
  return (x * x + y * y) + z * z;
}

/// Returns the gap of spheres that a distance makes, rounded up.
float gap_above(double distance) {
  const double wide = std::min(distance, 1e10) * (1 + 0x1p-19);
  const float nearest = static_cast<float>(wide);
  return static_cast<double>(nearest) < wide ? std::nextafter(nearest, std::numeric_limits<float>::infinity())
                                             : nearest;
}

}  // namespace

BodyReference::BodyReference(const BodySet& bodies) {
  for (std::uint32_t body = 0; body < bodies.body_count(); ++body) spheres_.push_back(bodies.spheres(body));
}

std::vector<Sphere> BodyReference::placed(const Agents& agents, Pair pair) const {
  const auto [a, b] = std::minmax(pair.first, pair.second);
  const FloatPlacement place = float_placement(agents, pair);
  const float dz = agents.z.empty() ? 0 : static_cast<float>(agents.z[b] - agents.z[a]);
  std::vector<Sphere> spheres = spheres_[agents.shape[b]];
  for (Sphere& s : spheres)
    s = {place.x + (place.cosine * s.x - place.sine * s.y), place.y + (place.sine * s.x + place.cosine * s.y),
         dz + s.z, s.radius};
  return spheres;
}

bool BodyReference::within(const Agents& agents, Pair pair, double distance) const {
  const float gap = gap_above(distance);
  const std::vector<Sphere> other = placed(agents, pair);
  for (const Sphere& a : spheres_[agents.shape[std::min(pair.first, pair.second)]])
    for (const Sphere& b : other) {
      const float radii = (a.radius + gap) + b.radius;
      if (square_between(a, b) <= radii * radii) return true;
    }
  return false;
}

BodyClearance BodyReference::clearance(const Agents& agents, Pair pair) const {
  const std::vector<Sphere>& own = spheres_[agents.shape[std::min(pair.first, pair.second)]];
  const std::vector<Sphere> other = placed(agents, pair);
  BodyClearance least{std::numeric_limits<float>::infinity(), 0, 0};
  for (std::uint32_t i = 0; i < own.size(); ++i)
    for (std::uint32_t j = 0; j < other.size(); ++j) {
      const float square = square_between(own[i], other[j]), radii = own[i].radius + other[j].radius;
      const float apart = std::sqrt(square) * (1 + 0x1p-21f) - radii;
      const float gap = square <= radii * radii ? std::min(apart, 0.0f) : apart * (1 - 0x1.8p-20f);
      if (gap < least.distance) least = {gap, i, j};
    }
  if (pair.second < pair.first) std::swap(least.first, least.second);
  return least;
}

float BodyReference::time_of_impact(const Agents& agents, Pair pair, double x, double y, double z) const {
  if (collide(agents, pair)) return 0;
  const auto [first, second] = std::minmax(pair.first, pair.second);
  const float sign = pair.second < pair.first ? -1.0f : 1.0f;
  const float dx = sign * static_cast<float>(x), dy = sign * static_cast<float>(y);
  const detail::UnitVector u = detail::unit_vector(agents.heading[first]);
  const float ahead = u.cosine * dx + u.sine * dy, left = u.cosine * dy - u.sine * dx;
  const double vx = static_cast<double>(ahead), vy = static_cast<double>(left),
               vz = static_cast<double>(sign * static_cast<float>(z));
  const std::vector<Sphere> other = placed(agents, pair);
  double least = std::numeric_limits<double>::infinity();
  for (const Sphere& a : spheres_[agents.shape[first]])
    for (const Sphere& b : other) {
      const double px = static_cast<double>(b.x - a.x), py = static_cast<double>(b.y - a.y),
                   pz = static_cast<double>(b.z - a.z);
      const double square = (px * px + py * py) + pz * pz, speed = (vx * vx + vy * vy) + vz * vz;
      const double towards = (px * vx + py * vy) + pz * vz;
      const double cx = py * vz - pz * vy, cy = pz * vx - px * vz, cz = px * vy - py * vx;
      const double touching = static_cast<double>(a.radius + b.radius) + 0x1p-19 * std::sqrt(square);
      const double inner = touching * touching * speed - ((cx * cx + cy * cy) + cz * cz);
      if (towards <= 0 || inner < 0) continue;
      const double gap = square - touching * touching;
      const double time = gap <= 0 ? 0 : gap / (towards + std::sqrt(inner)) * (1 - 0x1p-22);
      if (time <= 1) least = std::min(least, time);
    }
  return static_cast<float>(least);
}

}  // namespace bch::baselines
