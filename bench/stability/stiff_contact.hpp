// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <string>
#include <vector>

/// Measures depths as the springs of penalty forces: a stiff use that fails with a depth that jumps.
///
/// Agents of 80 kg are driven to 1 m/s within 0.5 s. Where two have a depth, a force k depth acts along its direction,
/// and a friction kappa depth times the sliding speed across it.
/// Source:  D. Helbing, I. Farkas, T. Vicsek, "Simulating dynamical features of escape panic", Nature 407, 2000, for the
///          constants; without the repulsion at a distance, which has nothing to do with a depth.
/// Time:    semi-implicit Euler, a fixed step. Headings stay.
namespace bch::bench {

namespace stiff {
constexpr double mass = 80, stiffness = 1.2e5, friction = 2.4e5;  // kg, kg/s^2, kg/(m s)
constexpr double wanted_speed = 1, relaxation = 0.5;              // m/s, s
}  // namespace stiff

/// Selects the source of depth and direction.
enum class DepthMeasure {
  penetration,  ///< penetration(), the best of 32 directions, of pairs that collide
  discs,        ///< clearance() below 0: the two discs of the cuts that overlap deepest, along their centres
  centres,      ///< penetration_along() the line of the agents' centres, of all pairs near enough
};
std::string name_of(DepthMeasure measure);

enum class StiffScene {
  two,   ///< two agents press against each other
  row,   ///< 20 in a corridor, one behind the other, press against a wall
  door,  ///< 200 press through a door
};

struct StiffRow {
  std::string scene, depth;
  DepthMeasure measure;
  double bound = 0;  ///< seconds: 2 / omega of springs alone
  double largest_step =
      0;              ///< seconds: of the steps that were tried, the largest up to which all were stable
  double jitter = 0;  ///< m/s, root mean square at rest, with a step of 1 ms; the door: no rest
};

/// Holds the results for two agents that fly into each other at 1 m/s, without drive and friction, and apart
/// again.
struct BounceRow {
  std::string depth;
  DepthMeasure measure;
  std::uint32_t bounces = 0;
  double onset = 0, largest_onset = 0;  ///< metres of depth in the first step of a contact: mean, largest
  double energy = 0, most_energy = 0;   ///< created, parts of what was there: mean of the size, largest
};

/// Holds the results for two agents that slide over each other by small steps.
struct SlideRow {
  std::string depth;
  DepthMeasure measure;
  double change =
      0;  ///< the largest change of the depth by the motion that it took; 1 at most, if nothing jumps
  double jump = 0;  ///< metres, the largest change in one step
  double turn = 0;  ///< radians, the largest change of the direction in one step
};

struct StiffOptions {
  double seconds = 4;          ///< of every simulation
  std::uint32_t people = 200;  ///< at the door; 0: no door
  std::uint32_t bounces = 100, slides = 100;
};

struct StiffReport {
  std::vector<StiffRow> rows;
  std::vector<BounceRow> bounces;
  std::vector<SlideRow> slides;
};

/// Runs all simulations, with the same results on every machine. Runs in the caller's TBB arena.
StiffReport stiff_contact(const StiffOptions& options);

}  // namespace bch::bench
