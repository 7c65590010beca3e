// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/ratios/counted_kernel.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::bench {
namespace {

struct Avx512Lanes : detail::Lanes<xsimd::avx512f, Avx512Lanes> {};
using Counted = CountedLanes<Avx512Lanes>;

}  // namespace

CountedKernel counted_avx512_kernel() {
  return {"avx512", Counted::run, Counted::counts};
}

}  // namespace bch::bench
