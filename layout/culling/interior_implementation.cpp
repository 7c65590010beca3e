// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/culling/interior_implementation.hpp"

namespace bch::detail {

extern const InteriorLoops interior_avx2, interior_base;

namespace {

const InteriorImplementation interior_table[] = {BCH_ON_X86({avx2, interior_avx2}, ){base, interior_base}};

}  // namespace

std::span<const InteriorImplementation> interior_implementations() noexcept {
  return interior_table;
}

const InteriorImplementation& best_interior_implementation() noexcept {
  static const InteriorImplementation& best = first_supported(interior_table);
  return best;
}

}  // namespace bch::detail
