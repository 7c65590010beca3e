// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/isa/row.hpp"

namespace bch::detail {
namespace {

/// Several rows of a block's outer product fit into one register: two of eight,
/// four of four.
struct Avx512Lanes : Lanes<xsimd::avx512f> {
  /// Leaves the registers' upper halves clean, which GCC 12 forgets on some
  /// ways out of a kernel: whatever the caller then does with SSE instructions
  /// takes up to five times as long.
  struct Guard {
    ~Guard() { _mm256_zeroupper(); }
  };
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
  static std::uint32_t write_set(std::uint32_t bits, std::uint32_t first, std::uint16_t* to) noexcept {
    const __m512i lanes = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    const __m512i all = _mm512_add_epi32(lanes, _mm512_set1_epi32(static_cast<int>(first)));
    const __m512i set = _mm512_maskz_compress_epi32(static_cast<__mmask16>(bits), all);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm512_cvtepi32_epi16(set));
    return static_cast<std::uint32_t>(__builtin_popcount(bits));
  }
  template <std::size_t stride>
  static void load_records(const float* table, const std::uint32_t* index, Float (&field)[4]) noexcept {
    const auto record = [=](std::size_t i) { return _mm_loadu_ps(table + stride * index[i]); };
    __m512 r[4];
#pragma GCC unroll 4
    for (std::size_t i = 0; i < 4; ++i) {
      r[i] = _mm512_castps128_ps512(record(i));
      r[i] = _mm512_insertf32x4(r[i], record(i + 4), 1);
      r[i] = _mm512_insertf32x4(r[i], record(i + 8), 2);
      r[i] = _mm512_insertf32x4(r[i], record(i + 12), 3);
    }
    const __m512d low01 = _mm512_castps_pd(_mm512_unpacklo_ps(r[0], r[1])),
                  low23 = _mm512_castps_pd(_mm512_unpacklo_ps(r[2], r[3])),
                  high01 = _mm512_castps_pd(_mm512_unpackhi_ps(r[0], r[1])),
                  high23 = _mm512_castps_pd(_mm512_unpackhi_ps(r[2], r[3]));
    field[0] = _mm512_castpd_ps(_mm512_unpacklo_pd(low01, low23));
    field[1] = _mm512_castpd_ps(_mm512_unpackhi_pd(low01, low23));
    field[2] = _mm512_castpd_ps(_mm512_unpacklo_pd(high01, high23));
    field[3] = _mm512_castpd_ps(_mm512_unpackhi_pd(high01, high23));
  }
  static Double gather(const double* p, const std::uint32_t* index) noexcept {
    const auto at = [=](std::size_t i) { return p[index[i]]; };
    return _mm512_setr_pd(at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7));
  }
  static Words gather(const std::uint32_t* p, const std::uint32_t* index) noexcept {
    const auto at = [=](std::size_t i) { return static_cast<int>(p[index[i]]); };
    return _mm512_setr_epi32(at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7), at(8), at(9), at(10),
                             at(11), at(12), at(13), at(14), at(15));
  }
  static Float rounded(const Double (&v)[2]) noexcept {
    return _mm512_castpd_ps(
        _mm512_insertf64x4(_mm512_castps_pd(_mm512_castps256_ps512(_mm512_cvtpd_ps(v[0]))),
                           _mm256_castps_pd(_mm512_cvtpd_ps(v[1])), 1));
  }
  static void widened(Float v, Double (&to)[2]) noexcept {
    to[0] = _mm512_cvtps_pd(_mm512_castps512_ps256(v));
    to[1] = _mm512_cvtps_pd(_mm256_castpd_ps(_mm512_extractf64x4_pd(_mm512_castps_pd(v), 1)));
  }
  static std::uint32_t bits(xsimd::batch_bool<float, xsimd::avx512f> hits) noexcept {
    return hits.data;
  }
  static float least(Float values) noexcept {
    return _mm512_reduce_min_ps(values);
  }
  static constexpr float rough = 0x1p-13f;
  static Float rough_root(Float x) noexcept {
    return x * Float(_mm512_rsqrt14_ps(x));
  }
};

}  // namespace

extern const Kernels avx512_kernels;
constinit const Kernels avx512_kernels = Row<Avx512Lanes>::kernels;

}  // namespace bch::detail
