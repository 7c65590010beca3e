// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/workload/clipper_union.hpp"

// Compiled in place of clipper_union.cpp where there is no libpolyclipping.

namespace bch::bench {

const bool has_clipper = false;

double clipper_union_area(std::span<const Vec2>, std::span<const std::array<std::uint32_t, 3>>, double) {
  return 0;
}

}  // namespace bch::bench
