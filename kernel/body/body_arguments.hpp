// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "kernel/simd/arguments.hpp"

namespace bch::detail {

struct BodySetView;

/// Holds what the kernel of bodies of spheres reads and writes: plain pointers only, as Arguments.
struct BodyArguments {
  Arguments pairs;  ///< agents, pairs and codes; its shapes are the discs of the bodies
  const BodySetView* bodies;
};

}  // namespace bch::detail
