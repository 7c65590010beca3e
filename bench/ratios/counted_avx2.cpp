// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/ratios/counted_kernel.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::bench {
namespace {

struct Avx2Lanes : detail::Lanes<xsimd::avx2, Avx2Lanes> {};
using Counted = CountedLanes<Avx2Lanes>;

}  // namespace

CountedKernel counted_avx2_kernel() {
  return {"avx2", Counted::run, Counted::counts};
}

}  // namespace bch::bench
