// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "kernel/body/body_arguments.hpp"

namespace bch::detail {

constexpr std::uint32_t no_slot = 0xffffffff;

/// Holds the spheres of two bodies that are nearest to each other, by their slots. The agent with the lower index is A.
struct NearestSpheres {
  float distance;      ///< metres
  std::uint32_t a, b;  ///< or no_slot where none is within the limit
};

/// Holds the input and output of the clearance kernel of bodies.
struct BodyClearanceArguments {
  BodyArguments in;         ///< without states
  float limit;              ///< distances above it are not searched for
  float stop_below;         ///< one at or below it ends a search
  NearestSpheres* nearest;  ///< as many as pairs
};

}  // namespace bch::detail
