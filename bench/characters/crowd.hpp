// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <vector>

#include <bch/agents.hpp>

namespace bch::cli {

/// Represents agents spread over a square, [0, side) in x and y.
struct Crowd {
  double side = 0;  ///< metres
  std::vector<std::uint32_t> shape;
  std::vector<double> x, y, heading;

  std::size_t size() const { return shape.size(); }
  Agents agents() const { return {shape, x, y, heading}; }
  /// Returns the agents, all at one level.
  Agents at_level(const std::vector<std::uint8_t>& level) const { return {shape, x, y, heading, level}; }
};

/// Places agents with positions, headings and shapes uniformly at random; the same for a seed everywhere.
Crowd place_crowd(std::uint32_t agents, double density, std::uint32_t shapes, std::uint64_t seed);

}  // namespace bch::cli
