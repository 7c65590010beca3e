// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

// Two crowd simulators, a page each, in which people are discs. They know nothing of bodies.

namespace bch::clients {

using Plane = std::complex<double>;  ///< metres, or metres a second

constexpr double usual_radius = 0.2, wanted_speed = 1.3, fastest = 1.8;  // metres, m/s

/// Holds people who are on their way.
struct People {
  std::vector<Plane> at, velocity, goal;
  std::vector<double> radius;  ///< metres, of discs
  double period = 0;           ///< metres, along x and y; 0: none

  std::size_t size() const { return at.size(); }
  /// Returns the shortest vector from one person to another.
  Plane between(std::size_t from, std::size_t to) const {
    const Plane apart = at[to] - at[from];
    if (period == 0) return apart;
    return {std::remainder(apart.real(), period), std::remainder(apart.imag(), period)};
  }
  Plane wanted(std::size_t i) const {
    const Plane way = goal[i] - at[i];
    return way * std::min(1.0, wanted_speed / std::max(1e-9, std::abs(way)));
  }
};

inline Plane no_faster(Plane velocity) {
  return velocity * std::min(1.0, fastest / std::max(1e-9, std::abs(velocity)));
}

inline double dot(Plane a, Plane b) {
  return (std::conj(a) * b).real();
}

/// Changes velocities by social forces: a drive to the goal, and exponential repulsion of discs.
/// Source:  D. Helbing, P. Molnar, "Social force model for pedestrian dynamics", Phys. Rev. E 51, 1995; circular.
inline void steer_by_social_forces(People& people, double seconds) {
  constexpr double relaxation = 0.5, strength = 4, reach = 0.15;  // s, m/s^2, m
  std::vector<Plane> force(people.size());
  for (std::size_t i = 0; i < people.size(); ++i) {
    force[i] += (people.wanted(i) - people.velocity[i]) / relaxation;
    for (std::size_t k = 0; k < i; ++k) {
      const Plane away = people.between(k, i);
      const double distance = std::max(1e-9, std::abs(away));
      const Plane push =
          std::min(40.0, strength * std::exp((people.radius[i] + people.radius[k] - distance) / reach)) *
          away / distance;
      force[i] += push, force[k] -= push;
    }
  }
  for (std::size_t i = 0; i < people.size(); ++i)
    people.velocity[i] = no_faster(people.velocity[i] + seconds * force[i]);
}

/// Represents the velocities v for which (v - point) . normal >= 0.
struct HalfPlane {
  Plane point, normal;
};

/// Returns the velocities with which the first of two discs does its half to avoid the second. `both`: the sum of their radii.
/// Source:  J. van den Berg, S. J. Guy, M. Lin, D. Manocha, "Reciprocal n-body collision avoidance", ISRR 2009, section 4.
inline HalfPlane avoid(Plane to_other, double both, Plane own, Plane relative, double horizon,
                       double seconds) {
  const double square = std::norm(to_other);
  const bool overlap = square < both * both;
  const double time = overlap ? seconds : horizon;
  const Plane from_cut = relative - to_other / time;
  if (overlap || (dot(from_cut, to_other) < 0 &&
                  dot(from_cut, to_other) * dot(from_cut, to_other) > both * both * std::norm(from_cut))) {
    const double length = std::max(1e-9, std::abs(from_cut));
    const Plane normal = from_cut / length;
    return {own + (both / time - length) / 2 * normal, normal};
  }
  const double leg = std::sqrt(square - both * both);
  const bool left = (std::conj(to_other) * from_cut).imag() > 0;
  const Plane along = to_other * (left ? Plane(leg, both) : Plane(-leg, both)) / square;
  return {own + (dot(relative, along) * along - relative) / 2.0, along * Plane(0, 1)};
}

/// Changes velocities to those nearest the wanted ones which avoid everybody else (ORCA). The projection onto all half planes is
/// found by projecting onto one after the other.
inline void steer_by_orca(People& people, double seconds) {
  constexpr double horizon = 2, reach = 5;  // s, m
  constexpr int rounds = 30;
  std::vector<Plane> velocity(people.size());
  for (std::size_t i = 0; i < people.size(); ++i) {
    std::vector<HalfPlane> allowed;
    for (std::size_t k = 0; k < people.size(); ++k)
      if (const Plane to = people.between(i, k); k != i && std::abs(to) < reach)
        allowed.push_back(avoid(to, people.radius[i] + people.radius[k], people.velocity[i],
                                people.velocity[i] - people.velocity[k], horizon, seconds));
    velocity[i] = people.wanted(i);
    for (int round = 0; round < rounds; ++round)
      for (const auto& [point, normal] : allowed)
        velocity[i] += std::max(0.0, dot(point - velocity[i], normal)) * normal;
    velocity[i] = no_faster(velocity[i]);
  }
  people.velocity = velocity;
}

}  // namespace bch::clients
