// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/culling/interior_implementation.hpp"

#include "layout/base/construction_implementation.hpp"

namespace bch::detail {

extern const InteriorLoops interior_avx512, interior_avx2, interior_sse2;

namespace {

// The compiler's test asks the operating system too, whether it saves the wide registers.
const InteriorImplementation table[] = {
    {"avx512", []() noexcept { return __builtin_cpu_supports("avx512f") != 0; }, interior_avx512},
    {"avx2", []() noexcept { return __builtin_cpu_supports("avx2") != 0; }, interior_avx2},
    {"sse2", []() noexcept { return true; }, interior_sse2},
};

}  // namespace

std::span<const InteriorImplementation> interior_implementations() noexcept {
  return table;
}

const InteriorImplementation& best_interior_implementation() noexcept {
  static const InteriorImplementation& best = best_for_construction(table);
  return best;
}

}  // namespace bch::detail
