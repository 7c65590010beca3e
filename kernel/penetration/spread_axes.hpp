// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <string>

#include "layout/base/heading.hpp"

namespace bch::detail {

constexpr std::uint32_t max_directions = 256;
constexpr std::uint32_t max_axes = max_directions / 2;

/// Holds directions of the world, as unit vectors within 1e-9.
struct Axes {
  double x[max_axes], y[max_axes];
  std::uint32_t count;
};

/// Returns half of a number of directions, evenly spread from the x axis on; the others are opposite.
/// Errors:  throws std::invalid_argument naming the query, on a number that is odd, below 2 or above 256.
inline Axes spread_axes(const char* query, std::uint32_t directions) {
  if (directions < 2 || directions > max_directions || directions % 2 != 0)
    throw std::invalid_argument(std::string(query) + ": expected an even number of directions from 2 to " +
                                std::to_string(max_directions) + ", found " + std::to_string(directions));
  Axes axes;
  axes.count = directions / 2;
  for (std::uint32_t i = 0; i < axes.count; ++i) {
    const Rotation axis = rotation(2 * std::numbers::pi * i / directions);
    axes.x[i] = axis.cosine, axes.y[i] = axis.sine;
  }
  return axes;
}

}  // namespace bch::detail
