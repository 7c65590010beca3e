// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/base/build_implementation.hpp"

namespace bch::detail {

extern const BuildLoops avx2_loops, base_loops;

namespace {

constexpr BuildImplementation table[] = {BCH_ON_X86({avx2, avx2_loops}, ){base, base_loops}};

}  // namespace

std::span<const BuildImplementation> build_implementations() noexcept {
  return table;
}

const BuildImplementation& best_build_implementation() noexcept {
  static const BuildImplementation& best = first_supported(table);
  return best;
}

}  // namespace bch::detail
