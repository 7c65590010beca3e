// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "kernel/simd/arguments.hpp"

namespace bch::kernel {

/// As Arguments, which says why plain pointers. Of a pair the agent with the lower index is A.
struct ContactTimeArguments {
  Arguments in;        ///< without codes; pairs that do not collide now
  const float *x, *y;  ///< per pair: how far A moves relative to B, metres, in the world
  float* time;         ///< per pair; infinite: none
};

}  // namespace bch::kernel
