// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/isa/row.hpp"

namespace bch::detail {
namespace {

/// Two rows of four fit into one register.
struct Avx2Lanes : Lanes<xsimd::avx2> {
  /// Leaves the registers' upper halves clean, which GCC 12 forgets on some
  /// ways out of a kernel: whatever the caller then does with SSE instructions
  /// takes up to five times as long.
  struct Guard {
    ~Guard() { _mm256_zeroupper(); }
  };
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
  template <std::size_t stride>
  static void load_records(const float* table, const std::uint32_t* index, Float (&field)[4]) noexcept {
    const auto record = [=](std::size_t i) { return _mm_loadu_ps(table + stride * index[i]); };
    __m256 r[4];
#pragma GCC unroll 4
    for (std::size_t i = 0; i < 4; ++i) r[i] = _mm256_set_m128(record(i + 4), record(i));
    const __m256d low01 = _mm256_castps_pd(_mm256_unpacklo_ps(r[0], r[1])),
                  low23 = _mm256_castps_pd(_mm256_unpacklo_ps(r[2], r[3])),
                  high01 = _mm256_castps_pd(_mm256_unpackhi_ps(r[0], r[1])),
                  high23 = _mm256_castps_pd(_mm256_unpackhi_ps(r[2], r[3]));
    field[0] = _mm256_castpd_ps(_mm256_unpacklo_pd(low01, low23));
    field[1] = _mm256_castpd_ps(_mm256_unpackhi_pd(low01, low23));
    field[2] = _mm256_castpd_ps(_mm256_unpacklo_pd(high01, high23));
    field[3] = _mm256_castpd_ps(_mm256_unpackhi_pd(high01, high23));
  }
  static Double gather(const double* p, const std::uint32_t* index) noexcept {
    return _mm256_setr_pd(p[index[0]], p[index[1]], p[index[2]], p[index[3]]);
  }
  static Words gather(const std::uint32_t* p, const std::uint32_t* index) noexcept {
    const auto at = [=](std::size_t i) { return static_cast<int>(p[index[i]]); };
    return _mm256_setr_epi32(at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7));
  }
  static Float rounded(const Double (&v)[2]) noexcept {
    return _mm256_set_m128(_mm256_cvtpd_ps(v[1]), _mm256_cvtpd_ps(v[0]));
  }
  static void widened(Float v, Double (&to)[2]) noexcept {
    to[0] = _mm256_cvtps_pd(_mm256_castps256_ps128(v)), to[1] = _mm256_cvtps_pd(_mm256_extractf128_ps(v, 1));
  }
  static std::uint32_t bits(xsimd::batch_bool<float, xsimd::avx2> hits) noexcept {
    return static_cast<std::uint32_t>(_mm256_movemask_ps(hits));
  }
  static float least(Float values) noexcept {
    const __m128 fours = _mm_min_ps(_mm256_castps256_ps128(values), _mm256_extractf128_ps(values, 1));
    const __m128 pairs = _mm_min_ps(fours, _mm_movehl_ps(fours, fours));
    return _mm_cvtss_f32(_mm_min_ss(pairs, _mm_shuffle_ps(pairs, pairs, 1)));
  }
  static constexpr float rough = 0x1p-11f;
  static Float rough_root(Float x) noexcept {
    return x * Float(_mm256_rsqrt_ps(x));
  }
};

}  // namespace

extern const Kernels avx2_kernels;
constinit const Kernels avx2_kernels = Row<Avx2Lanes>::kernels;

}  // namespace bch::detail
