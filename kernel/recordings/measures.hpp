// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "kernel/recordings/walkers.hpp"

namespace bch::detail {

// Constants of the intrusion and avoidance numbers, as in PedPy. Cordes, Schadschneider, Nicolas: "Dimensionless
// numbers reveal distinct regimes in the structure and dynamics of pedestrian crowds", PNAS Nexus 3(4), 2024,
// pgae120.
constexpr double social_distance = 0.8;                     ///< metres: r_soc
constexpr double farthest_neighbour = 3 * social_distance;  ///< metres, between centres
constexpr double avoidance_seconds = 3;                     ///< tau_0

/// The radius of discs that are measured in addition to bodies, metres: half of l_min of that paper, and the
/// radius of TrajNet++'s collisions.
constexpr double measured_disc = 0.1;

constexpr double measured_clearance =
    social_distance - 2 * measured_disc;  ///< metres: larger gaps of bodies are not measured
constexpr double measured_seconds = 5;    ///< the largest time to collision, and since an encroachment

// Distances of personal space, between centres, metres; Hall: "The hidden dimension", 1966.
constexpr double intimate_space = 0.45, personal_space = 1.2;

constexpr double cell_radius = 1.2;     ///< metres: Voronoi cells are clipped at this distance
constexpr std::size_t cell_sides = 12;  ///< of the clipping polygon

/// Holds the measures of a person in a frame. Minima are over all other people of the frame, and infinite if
/// nobody is within range.
struct MeasuredPerson {
  static constexpr float infinite = std::numeric_limits<float>::infinity();

  float voronoi_density = 0;                              ///< people per square metre
  float clearance = infinite, disc_clearance = infinite;  ///< minimum, metres; in an overlap, minus its depth
  float time = infinite,
        disc_time = infinite;  ///< minimum time to a collision at present velocities, seconds
  float intrusion = 0, disc_intrusion = 0;
  float encroachment =
      infinite;  ///< seconds since another person's disc touched this person's disc at its present position
  std::uint32_t intimate = 0, personal = 0;  ///< other people within these distances, between positions
  bool collides = false;  ///< overlaps somebody in this frame, or passes through somebody before the next
  bool disc_collides = false;  ///< in this frame, or halfway between this and the next

  static float avoidance(float time) { return static_cast<float>(avoidance_seconds) / time; }
};

/// Holds the measures of two people of a frame who overlap, as bodies or as discs, or will do so at present
/// velocities.
struct MeasuredPair {
  std::int64_t first, second;  ///< ids
  float distance;              ///< between centres, metres
  float clearance, disc_clearance;
  float time, disc_time;
};

/// Returns the time at which two discs touch, for a relative position (x, y) and a relative velocity (vx, vy)
/// per second: 0 if they overlap, infinity if they never touch. Both are second - first, or both first -
/// second.
inline double disc_collision(double x, double y, double vx, double vy, double radius_sum) noexcept {
  // The smaller root of |p + t v|^2 = r^2, in the form that does not cancel.
  const double gap = x * x + y * y - radius_sum * radius_sum;
  if (gap <= 0) return 0;
  const double approach = -(x * vx + y * vy), speed = vx * vx + vy * vy;
  const double under_root = approach * approach - speed * gap;
  if (!(approach > 0 && under_root >= 0)) return std::numeric_limits<double>::infinity();
  return gap / (approach + std::sqrt(under_root));
}

/// Computes the measures that depend only on the positions of the people of a frame, in their order:
/// neighbours, discs and Voronoi cells. Keeps its memory for the next frame.
class NeighbourMeasures {
 public:
  /// `x`, `y`: positions. `step_x`, `step_y`: displacements until the next frame, 0 if there is none.
  void measure(std::span<const double> x, std::span<const double> y, std::span<const double> step_x,
               std::span<const double> step_y, std::span<MeasuredPerson> people);

 private:
  struct Placed {
    std::int64_t row, column;  ///< of a grid with an origin of its own
    std::uint32_t person;
    double x, y, step_x, step_y;
  };
  struct Neighbour {
    double square, x, y;  ///< square of the distance; vector to the neighbour
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
