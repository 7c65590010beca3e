// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "kernel/recordings/walkers.hpp"

namespace bch::detail {

// Numbers of the intrusion and the avoidance of Cordes, Schadschneider, Nicolas: "Dimensionless numbers reveal distinct regimes in the
// structure and dynamics of pedestrian crowds", PNAS Nexus 3(4), 2024, pgae120; as PedPy computes them.
constexpr double social_distance = 0.8;                     ///< metres: r_soc
constexpr double farthest_neighbour = 3 * social_distance;  ///< metres, between centres
constexpr double avoidance_seconds = 3;                     ///< tau_0

/// The radius of discs beside bodies, metres: half of l_min of the same paper, and the radius of TrajNet++'s collisions.
constexpr double measured_disc = 0.1;

constexpr double measured_clearance =
    social_distance - 2 * measured_disc;  ///< metres: bodies farther apart are not measured
constexpr double measured_seconds =
    5;  ///< how far times to collision look ahead, and times after an encroachment back

// Distances of personal space, between centres, metres; Hall: "The hidden dimension", 1966.
constexpr double intimate_space = 0.45, personal_space = 1.2;

constexpr double cell_radius = 1.2;     ///< metres: where cells end in any case
constexpr std::size_t cell_sides = 12;  ///< of the polygon with that radius

/// Describes what is measured of a person of a frame. Least values are over all others of the frame, and infinite beyond what is measured.
struct MeasuredPerson {
  static constexpr float infinite = std::numeric_limits<float>::infinity();

  float voronoi_density = 0;                              ///< people per square metre
  float clearance = infinite, disc_clearance = infinite;  ///< the least, metres; below 0: minus the depth
  float time = infinite, disc_time = infinite;  ///< the least to a collision at present velocities, seconds
  float intrusion = 0, disc_intrusion = 0;
  float encroachment =
      infinite;  ///< seconds since the disc of another person touched the disc of this one, where it now is
  std::uint32_t intimate = 0, personal = 0;  ///< others within these distances, between centres
  bool collides = false;       ///< overlaps somebody in this frame, or passes somebody before the next
  bool disc_collides = false;  ///< in this frame, or halfway between this and the next

  static float avoidance(float time) { return static_cast<float>(avoidance_seconds) / time; }
};

/// Describes two people of a frame who overlap, as bodies or as discs, or will do so at present velocities.
struct MeasuredPair {
  std::int64_t first, second;  ///< ids
  float distance;              ///< between centres, metres
  float clearance, disc_clearance;
  float time, disc_time;
};

/// Returns when two discs touch whose centres are x, y apart, and move by vx, vy a second: 0 where they overlap, infinity where they never
/// do. Positions and velocities are the second's less the first's, or the first's less the second's.
double disc_collision(double x, double y, double vx, double vy, double radius_sum) noexcept;

/// Measures what depends on the places of the people of one frame alone: neighbours, discs and Voronoi cells. Keeps its memory for the
/// next frame. Answers depend on nothing but these places, and the order of the people.
class NeighbourMeasures {
 public:
  /// `x` and `y` are places, and `step_x` and `step_y` ways to the next frame, 0 where there is none.
  void measure(std::span<const double> x, std::span<const double> y, std::span<const double> step_x,
               std::span<const double> step_y, std::span<MeasuredPerson> people);

 private:
  struct Placed {
    std::int64_t row, column;  ///< of a grid with an origin of its own
    std::uint32_t person;
    double x, y, step_x, step_y;
  };
  struct Neighbour {
    double square, x, y;  ///< of the distance; the way to it
  };
  struct Corner {
    double x, y;
  };

  void add(std::span<const Placed> some, const Placed& own, MeasuredPerson& person);
  double cell_area();
  void cut(const Neighbour& neighbour);
  double square_extent() const;

  std::vector<Placed> placed_;
  std::vector<Neighbour> neighbours_;
  std::vector<Corner> cell_, kept_;
};

}  // namespace bch::detail
