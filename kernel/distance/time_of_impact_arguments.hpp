// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "kernel/simd/arguments.hpp"

namespace bch::detail {

/// Holds the input and output of a time of impact kernel, as plain pointers for the reason given at
/// Arguments. The agent of a pair with the lower index is A.
struct TimeOfImpactArguments {
  Arguments in;        ///< without states; pairs that do not collide at the start
  const float *x, *y;  ///< per pair: the displacement of A relative to B, metres, in the world
  float* time;         ///< per pair; infinite: no contact
};

}  // namespace bch::detail
