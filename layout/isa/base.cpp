// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/isa/build_loops.hpp"

namespace bch::detail {

extern const BuildLoops base_loops;
constinit const BuildLoops base_loops = build_loops<BaseLanes>;

}  // namespace bch::detail
