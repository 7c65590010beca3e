// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/agent_check.hpp"
#include "kernel/pair_kernel.hpp"

namespace bch::kernel {
namespace {

/// Several rows of a block's outer product fit into one register: two of eight, four of four.
struct Avx512Lanes : Lanes<xsimd::avx512f> {
  static Float eight(const float* p) noexcept { return columns<8>(p, 0); }
  template <unsigned count>
  static Float row(Float eight, unsigned i) noexcept {
    const auto k = [i](unsigned lane) { return static_cast<int>(i + lane / count); };
    return _mm512_permutexvar_ps(_mm512_setr_epi32(k(0), k(1), k(2), k(3), k(4), k(5), k(6), k(7), k(8), k(9),
                                                   k(10), k(11), k(12), k(13), k(14), k(15)),
                                 eight);
  }
  template <unsigned count>
  static Float columns(const float* eight, unsigned) noexcept {
    if constexpr (count == 4) return _mm512_broadcast_f32x4(_mm_loadu_ps(eight));
    return _mm512_castpd_ps(_mm512_broadcast_f64x4(_mm256_castps_pd(_mm256_loadu_ps(eight))));
  }
  static void store_rounded(float* p, Double v) noexcept { _mm256_storeu_ps(p, _mm512_cvtpd_ps(v)); }
  static std::uint32_t bits(xsimd::batch_bool<float, xsimd::avx512f> hits) noexcept { return hits.data; }
};

}  // namespace

bool check_avx512(const Arguments& arguments, std::size_t begin, std::size_t end) noexcept {
  return AgentCheck<Avx512Lanes>::passes(arguments, begin, end);
}

void run_avx512(const Arguments& arguments, std::size_t begin, std::size_t end) noexcept {
  PairKernel<Avx512Lanes>::run(arguments, begin, end);
}

}  // namespace bch::kernel
