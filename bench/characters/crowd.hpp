// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bch/agents.hpp>
#include <bch/poses.hpp>

#include "bench/characters/characters.hpp"

namespace bch::cli {

/// Represents agents spread over a square, [0, side) in x and y.
struct Crowd {
  double side = 0;  ///< metres
  std::vector<std::uint32_t> shape;
  std::vector<double> x, y, heading;
  std::vector<double> z = {};  ///< heights of the grounds, or none

  std::size_t size() const { return shape.size(); }
  Agents agents() const { return {.shape = shape, .x = x, .y = y, .heading = heading, .z = z}; }
  /// Returns the agents, all at one level.
  Agents at_level(const std::vector<std::uint8_t>& level) const { return {shape, x, y, heading, level}; }
};

/// Places agents with positions, headings and shapes uniformly at random; the same for a seed everywhere.
Crowd place_crowd(std::uint32_t agents, double density, std::uint32_t shapes, std::uint64_t seed);

/// Represents agents who walk straight on over a square, each in a pose of its own: a clip chosen at random, and a time of its own in it.
/// Agent i has the number i for a shape. Who leaves the square comes in again on the other side.
class WalkingCrowd {
 public:
  /// Places the agents; the same for a seed everywhere. The characters have to outlive it.
  WalkingCrowd(std::span<const LoadedCharacter> characters, std::uint32_t agents, double density,
               std::uint64_t seed);

  /// Lets everybody walk on for a frame of 1/60 s.
  void step();

  const Crowd& crowd() const { return crowd_; }
  std::span<const PoseId> poses() const { return poses_; }  ///< one an agent

 private:
  const std::vector<Clip>& clips_of(const PoseId& pose) const;

  std::span<const LoadedCharacter> characters_;
  Crowd crowd_;
  std::vector<PoseId> poses_;
};

}  // namespace bch::cli
