// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <immintrin.h>

#include "layout/simd/any_lanes.hpp"

namespace bch::detail {

/// Provides the lanes of SSE2. This header alone names instructions of x86-64. AnyLanes says what each operation does,
/// and tests/layout/lanes_test.cpp compares them with that.
template <class Own>
struct Lanes<xsimd::sse2, Own> : AnyLanes<xsimd::sse2, Own> {
  using typename AnyLanes<xsimd::sse2, Own>::Float;
  using typename AnyLanes<xsimd::sse2, Own>::Double;

  static Float min(Float first, Float second) noexcept { return _mm_min_ps(first, second); }
  static Float max(Float first, Float second) noexcept { return _mm_max_ps(first, second); }
  static Float nan_where(xsimd::batch_bool<float, xsimd::sse2> mask, Float v) noexcept {
    return _mm_or_ps(mask, v);
  }
  static Float zero_unless(xsimd::batch_bool<float, xsimd::sse2> mask, Float v) noexcept {
    return _mm_and_ps(mask, v);
  }
  static std::uint32_t bits(xsimd::batch_bool<float, xsimd::sse2> mask) noexcept {
    return static_cast<std::uint32_t>(_mm_movemask_ps(mask));
  }
  static std::uint32_t bits(xsimd::batch_bool<double, xsimd::sse2> mask) noexcept {
    return static_cast<std::uint32_t>(_mm_movemask_pd(mask));
  }
  static std::uint32_t bits(xsimd::batch_bool<std::int32_t, xsimd::sse2> mask) noexcept {
    return static_cast<std::uint32_t>(_mm_movemask_ps(_mm_castsi128_ps(mask)));
  }
  static std::uint32_t bits(xsimd::batch_bool<std::int16_t, xsimd::sse2> mask) noexcept {
    return static_cast<std::uint32_t>(_mm_movemask_epi8(_mm_packs_epi16(mask, _mm_setzero_si128())));
  }
  static std::size_t count(std::uint32_t bits) noexcept {
    bits -= bits >> 1 & 0x5555;
    bits = (bits & 0x3333) + (bits >> 2 & 0x3333);
    bits = (bits + (bits >> 4)) & 0x0f0f;
    return (bits + (bits >> 8)) & 0x1f;
  }
  template <std::size_t stride>
  static void load_integers(const std::int32_t* table, const std::uint32_t* index,
                            Double (&field)[4]) noexcept {
    const auto record = [=](std::size_t i) {
      return _mm_loadu_si128((const __m128i*)(table + stride * index[i]));
    };
    const __m128i low = _mm_unpacklo_epi32(record(0), record(1)),
                  high = _mm_unpackhi_epi32(record(0), record(1));
    field[0] = _mm_cvtepi32_pd(low), field[1] = _mm_cvtepi32_pd(_mm_unpackhi_epi64(low, low));
    field[2] = _mm_cvtepi32_pd(high), field[3] = _mm_cvtepi32_pd(_mm_unpackhi_epi64(high, high));
  }
  static float least(Float values) noexcept {
    const __m128 pairs = _mm_min_ps(values, _mm_movehl_ps(values, values));
    return _mm_cvtss_f32(_mm_min_ss(pairs, _mm_shuffle_ps(pairs, pairs, 1)));
  }
  static Float to_float(const Double (&v)[2]) noexcept {
    return _mm_movelh_ps(_mm_cvtpd_ps(v[0]), _mm_cvtpd_ps(v[1]));
  }
  static void to_double(Float v, Double (&to)[2]) noexcept {
    to[0] = _mm_cvtps_pd(v), to[1] = _mm_cvtps_pd(_mm_movehl_ps(v, v));
  }
  static Double wide(const float* p) noexcept {
    return _mm_cvtps_pd(_mm_castpd_ps(_mm_set_sd(AnyLanes<xsimd::sse2, Own>::pair(p))));
  }
  static constexpr float approximation_error = 0x1p-11f;
  static Float approximate_sqrt(Float x) noexcept { return x * xsimd::rsqrt(x); }
};

#if XSIMD_WITH_AVX2
/// Provides the lanes of AVX2. Two rows of four fit into one register.
template <class Own>
struct Lanes<xsimd::avx2, Own> : AnyLanes<xsimd::avx2, Own> {
  using Base = AnyLanes<xsimd::avx2, Own>;
  using typename Base::Double;
  using typename Base::Float;

  /// Leaves the registers' upper halves clean, which GCC 12 forgets on some ways out of a kernel: whatever the caller
  /// then does with SSE instructions takes up to five times as long.
  struct Guard {
    ~Guard() { _mm256_zeroupper(); }
  };
  template <unsigned count>
  static Float row(const float* eight, unsigned i) noexcept {
    if constexpr (count == Base::width) return Float(eight[i]);
    const auto k = [i](unsigned lane) { return static_cast<int>(i % 4 + lane / 4); };
    return _mm256_permutevar_ps(_mm256_broadcast_ps(reinterpret_cast<const __m128*>(eight + i / 4 * 4)),
                                _mm256_setr_epi32(k(0), k(1), k(2), k(3), k(4), k(5), k(6), k(7)));
  }
  template <unsigned count>
  static Float columns(const float* eight, unsigned) noexcept {
    if constexpr (count == Base::width) return Base::load(eight);
    return _mm256_broadcast_ps(reinterpret_cast<const __m128*>(eight));
  }
  using Base::load_pairs;
  template <class At>
  static void load_pairs(At at, Double (&to)[2]) noexcept {
    const auto two = [&](std::size_t i) {
      return _mm_castpd_ps(_mm_setr_pd(Base::pair(at(i)), Base::pair(at(i + 1))));
    };
    const __m128 low = two(0), high = two(2);
    to[0] = _mm256_cvtps_pd(_mm_shuffle_ps(low, high, _MM_SHUFFLE(2, 0, 2, 0)));
    to[1] = _mm256_cvtps_pd(_mm_shuffle_ps(low, high, _MM_SHUFFLE(3, 1, 3, 1)));
  }
  template <class At>
  [[gnu::always_inline]] static Float broadcast_quads(At at) noexcept {
    return _mm256_set_m128(_mm_loadu_ps(at(1)), _mm_loadu_ps(at(0)));
  }
  static Float to_float(const Double (&v)[2]) noexcept {
    return _mm256_set_m128(_mm256_cvtpd_ps(v[1]), _mm256_cvtpd_ps(v[0]));
  }
  static void to_double(Float v, Double (&to)[2]) noexcept {
    to[0] = _mm256_cvtps_pd(_mm256_castps256_ps128(v)), to[1] = _mm256_cvtps_pd(_mm256_extractf128_ps(v, 1));
  }
  static Double wide(const float* p) noexcept { return _mm256_cvtps_pd(_mm_loadu_ps(p)); }
  static std::uint32_t bits(xsimd::batch_bool<float, xsimd::avx2> mask) noexcept {
    return static_cast<std::uint32_t>(_mm256_movemask_ps(mask));
  }
  static std::uint32_t bits(xsimd::batch_bool<double, xsimd::avx2> mask) noexcept {
    return static_cast<std::uint32_t>(_mm256_movemask_pd(mask));
  }
  static std::uint32_t bits(xsimd::batch_bool<std::int16_t, xsimd::avx2> mask) noexcept {
    const __m256i all = mask;
    return static_cast<std::uint32_t>(
        _mm_movemask_epi8(_mm_packs_epi16(_mm256_castsi256_si128(all), _mm256_extracti128_si256(all, 1))));
  }
  template <std::size_t stride>
  static void load_integers(const std::int32_t* table, const std::uint32_t* index,
                            Double (&field)[4]) noexcept {
    const auto record = [=](std::size_t i) {
      return _mm_loadu_si128((const __m128i*)(table + stride * index[i]));
    };
    const __m128i low01 = _mm_unpacklo_epi32(record(0), record(1)),
                  low23 = _mm_unpacklo_epi32(record(2), record(3)),
                  high01 = _mm_unpackhi_epi32(record(0), record(1)),
                  high23 = _mm_unpackhi_epi32(record(2), record(3));
    field[0] = _mm256_cvtepi32_pd(_mm_unpacklo_epi64(low01, low23));
    field[1] = _mm256_cvtepi32_pd(_mm_unpackhi_epi64(low01, low23));
    field[2] = _mm256_cvtepi32_pd(_mm_unpacklo_epi64(high01, high23));
    field[3] = _mm256_cvtepi32_pd(_mm_unpackhi_epi64(high01, high23));
  }
  static float least(Float values) noexcept {
    const __m128 quads = _mm_min_ps(_mm256_castps256_ps128(values), _mm256_extractf128_ps(values, 1));
    const __m128 pairs = _mm_min_ps(quads, _mm_movehl_ps(quads, quads));
    return _mm_cvtss_f32(_mm_min_ss(pairs, _mm_shuffle_ps(pairs, pairs, 1)));
  }
  static constexpr float approximation_error = 0x1p-11f;
  static Float approximate_sqrt(Float x) noexcept { return x * xsimd::rsqrt(x); }
};
#endif

#if XSIMD_WITH_AVX512F
/// Provides the lanes of AVX-512. Several rows of a block's outer product fit into one register: two of
/// eight, four of four.
template <class Own>
struct Lanes<xsimd::avx512f, Own> : AnyLanes<xsimd::avx512f, Own> {
  using Base = AnyLanes<xsimd::avx512f, Own>;
  using typename Base::Double;
  using typename Base::Float;

  /// Clears the upper halves of the registers at the end, as that of AVX2 does.
  struct Guard {
    ~Guard() { _mm256_zeroupper(); }
  };
  static Float load_eight(const float* p) noexcept { return columns<8>(p, 0); }
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
  static std::uint32_t compress_indices(std::uint32_t bits, std::uint32_t first, std::uint16_t* to) noexcept {
    const __m512i lanes = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    const __m512i all = _mm512_add_epi32(lanes, _mm512_set1_epi32(static_cast<int>(first)));
    const __m512i set = _mm512_maskz_compress_epi32(static_cast<__mmask16>(bits), all);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm512_cvtepi32_epi16(set));
    return static_cast<std::uint32_t>(__builtin_popcount(bits));
  }
  template <class At>
  [[gnu::always_inline]] static Float broadcast_quads(At at) noexcept {
    __m512 all = _mm512_castps128_ps512(_mm_loadu_ps(at(0)));
    all = _mm512_insertf32x4(all, _mm_loadu_ps(at(1)), 1);
    all = _mm512_insertf32x4(all, _mm_loadu_ps(at(2)), 2);
    return _mm512_insertf32x4(all, _mm_loadu_ps(at(3)), 3);
  }
  static Float to_float(const Double (&v)[2]) noexcept {
    return _mm512_castpd_ps(
        _mm512_insertf64x4(_mm512_castps_pd(_mm512_castps256_ps512(_mm512_cvtpd_ps(v[0]))),
                           _mm256_castps_pd(_mm512_cvtpd_ps(v[1])), 1));
  }
  static void to_double(Float v, Double (&to)[2]) noexcept {
    to[0] = _mm512_cvtps_pd(_mm512_castps512_ps256(v));
    to[1] = _mm512_cvtps_pd(_mm256_castpd_ps(_mm512_extractf64x4_pd(_mm512_castps_pd(v), 1)));
  }
  static Double wide(const float* p) noexcept { return _mm512_cvtps_pd(_mm256_loadu_ps(p)); }
  static std::uint32_t bits(xsimd::batch_bool<float, xsimd::avx512f> mask) noexcept { return mask.data; }
  static std::uint32_t bits(xsimd::batch_bool<double, xsimd::avx512f> mask) noexcept { return mask.data; }
  static float least(Float values) noexcept { return _mm512_reduce_min_ps(values); }
  static constexpr float approximation_error = 0x1p-13f;
  static Float approximate_sqrt(Float x) noexcept { return x * Float(_mm512_rsqrt14_ps(x)); }
};
#endif

}  // namespace bch::detail
