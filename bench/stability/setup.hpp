// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <functional>

#include "bench/stability/stability.hpp"
#include "bench/stability/trial.hpp"

namespace bch::bench {

enum class Placing {
  contact,     ///< half of the pairs with discs, half with outlines near contact
  coincident,  ///< one shape twice, at one place or some bits beside it
  stacked,     ///< one above the other
  apart,       ///< as far as the setup says
};

/// Selects how the pairs of a row are made.
struct StabilitySetup {
  std::string value;
  double conditioning = 0;
  bool outside = false;    ///< of the documented domain
  std::uint32_t cost = 1;  ///< only one in so many pairs is tried, at least 20
  std::function<std::vector<Specimen>(detail::Random&)> make = [](detail::Random& random) {
    return usual_specimens(random, 1);
  };
  /// Makes the shapes of the second agent; null: as of the first.
  std::function<std::vector<Specimen>(detail::Random&)> make_other = nullptr;
  ShapeSetPlan plan = {};
  Placing placing = Placing::contact;
  double x = 0, y = 0, z = 0;       ///< of the first agent
  double apart_x = 0, apart_y = 0;  ///< the second agent's position from there, where they are apart
  std::function<double(detail::Random&)> heading = nullptr;  ///< null: all directions
  /// Draws a gap from the sum of two radii and the sum of the reaches; null: gaps of all sizes.
  std::function<double(detail::Random&, double radii, double reaches)> gap = nullptr;
};

/// Returns the distance from a value to the next float or double.
double float_step(double value);
double double_step(double value);

StabilityRow run_setup(const char* family, const StabilitySetup& setup, std::uint32_t pairs,
                       std::uint64_t seed);

}  // namespace bch::bench
