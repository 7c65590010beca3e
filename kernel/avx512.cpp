// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/agent_check.hpp"
#include "kernel/pair_kernel.hpp"

namespace bch::kernel {
namespace {

/// Two rows of a block's outer product fit into one register.
struct Avx512Lanes : Lanes<xsimd::avx512f> {
  static Float eight(const float* p) noexcept { return columns(p, 0); }
  static Float row(Float eight, unsigned i) noexcept {
    const auto k = static_cast<int>(i);
    return _mm512_permutexvar_ps(
        _mm512_setr_epi32(k, k, k, k, k, k, k, k, k + 1, k + 1, k + 1, k + 1, k + 1, k + 1, k + 1, k + 1),
        eight);
  }
  static Float columns(const float* eight, unsigned) noexcept {
    return _mm512_castpd_ps(_mm512_broadcast_f64x4(_mm256_castps_pd(_mm256_loadu_ps(eight))));
  }
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
