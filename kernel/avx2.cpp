// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/agent_check.hpp"
#include "kernel/pair_kernel.hpp"

namespace bch::kernel {
namespace {

/// Two rows of four fit into one register.
struct Avx2Lanes : Lanes<xsimd::avx2> {
  template <unsigned count>
  static Float row(const float* eight, unsigned i) noexcept {
    if constexpr (count == width) return Float(eight[i]);
    return _mm256_set_m128(_mm_set1_ps(eight[i + 1]), _mm_set1_ps(eight[i]));
  }
  template <unsigned count>
  static Float columns(const float* eight, unsigned) noexcept {
    if constexpr (count == width) return load(eight);
    return _mm256_broadcast_ps(reinterpret_cast<const __m128*>(eight));
  }
  static void store_rounded(float* p, Double v) noexcept { _mm_storeu_ps(p, _mm256_cvtpd_ps(v)); }
  static std::uint32_t bits(xsimd::batch_bool<float, xsimd::avx2> hits) noexcept {
    return static_cast<std::uint32_t>(_mm256_movemask_ps(hits));
  }
};

}  // namespace

bool check_avx2(const Arguments& arguments, std::size_t begin, std::size_t end) noexcept {
  return AgentCheck<Avx2Lanes>::passes(arguments, begin, end);
}

void run_avx2(const Arguments& arguments, std::size_t begin, std::size_t end) noexcept {
  PairKernel<Avx2Lanes>::run(arguments, begin, end);
}

}  // namespace bch::kernel
