// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/pair_kernel.hpp"

namespace bch::kernel {
namespace {

/// Two rows of a block's outer product fit into one register.
struct Avx512Lanes : Lanes<xsimd::avx512f> {
  static Float row(const float* eight, unsigned i) noexcept {
    constexpr __mmask16 upper = 0xff00;
    return _mm512_mask_blend_ps(upper, _mm512_set1_ps(eight[i]), _mm512_set1_ps(eight[i + 1]));
  }
  static Float columns(const float* eight, unsigned) noexcept {
    return _mm512_castpd_ps(_mm512_broadcast_f64x4(_mm256_castps_pd(_mm256_loadu_ps(eight))));
  }
  static std::uint32_t bits(xsimd::batch_bool<float, xsimd::avx512f> hits) noexcept { return hits.data; }
};

}  // namespace

void run_avx512(const Arguments& arguments, std::size_t begin, std::size_t end) noexcept {
  PairKernel<Avx512Lanes>::run(arguments, begin, end);
}

}  // namespace bch::kernel
