// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>
#include <vector>

#include <bch/crowd.hpp>
#include <bch/pairs.hpp>

#include "bench/stability/stiff_contact.hpp"

namespace bch::bench {

/// Levels of detail of every shape, and the shapes: people in some poses, then pieces of wall.
constexpr std::uint32_t stiff_depths[] = {0, 3, 6, all_depths};
constexpr std::uint8_t finest_level = 3;
constexpr std::uint32_t people_shapes = 8;
enum WallShape : std::uint32_t { wall_of_10_m = people_shapes };
const ShapeSet& stiff_shapes();

struct Ground {
  double x = 0, y = 0;
};

/// Computes the depths of overlapping pairs by one of the measures.
class Depths {
 public:
  explicit Depths(DepthMeasure measure) : measure_(measure) {}

  /// Returns the pairs that may have depths: those that collide, or all candidates for a measure that does
  /// not need a collision.
  std::span<const Pair> pairs(const Agents& agents);
  /// Returns the depths of such pairs; valid until the next call.
  std::span<const Penetration> of(const Agents& agents, std::span<const Pair> pairs);

 private:
  void measure_discs(const Agents& agents, std::span<const Pair> pairs);

  DepthMeasure measure_;
  bch::Crowd finder_;
  std::vector<Penetration> found_;
  std::vector<Vec2> lines_, direction_;
  std::vector<float> distance_;
};

/// Simulates agents and the forces that move them.
class StiffWorld {
 public:
  explicit StiffWorld(DepthMeasure measure, bool free = false) : depths_(measure), free_(free) {}

  void add_person(std::uint32_t shape, std::uint8_t level, Ground at, double heading, Ground velocity);
  void add_wall(Ground at, double heading);

  /// Advances the simulation by one step. `goal`: of each person, a unit vector.
  void step(double seconds, std::span<const Ground> goal);

  std::size_t people() const { return velocity_.size(); }
  Ground position(std::size_t i) const { return {x_[i], y_[i]}; }
  Ground velocity(std::size_t i) const { return velocity_[i]; }
  double fastest() const;                      ///< m/s
  double mean_square() const;                  ///< of speeds
  double deepest() const { return deepest_; }  ///< metres, in the last step

 private:
  Agents agents() const { return {shape_, x_, y_, heading_, level_}; }
  void press(Pair pair, const Penetration& by);

  Depths depths_;
  bool free_;  ///< no drive, no friction
  std::vector<std::uint32_t> shape_;
  std::vector<std::uint8_t> level_;
  std::vector<double> x_, y_, heading_;  ///< people first, then walls
  std::vector<Ground> velocity_, force_;
  double deepest_ = 0;
};

}  // namespace bch::bench
