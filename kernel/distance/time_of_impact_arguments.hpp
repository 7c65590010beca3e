// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "kernel/simd/arguments.hpp"

namespace bch::detail {

/// Holds the input and output of a time of impact kernel. These are plain pointers for the reason that Arguments
/// states. The agent of a pair with the lower index is A.
struct TimeOfImpactArguments {
  Arguments in;        ///< without states; pairs that do not collide now
  const float *x, *y;  ///< per pair: how far A moves relative to B, metres, in the world
  float* time;         ///< per pair; infinite: none
};

}  // namespace bch::detail
