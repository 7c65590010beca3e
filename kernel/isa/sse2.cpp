// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/isa/row.hpp"

namespace bch::detail {
namespace {

struct Sse2Lanes : Lanes<xsimd::sse2> {
  struct Guard {};
  template <std::size_t stride>
  static void load_records(const float* table, const std::uint32_t* index, Float (&field)[4]) noexcept {
    const auto record = [=](std::size_t i) { return _mm_loadu_ps(table + stride * index[i]); };
    __m128 r0 = record(0), r1 = record(1), r2 = record(2), r3 = record(3);
    _MM_TRANSPOSE4_PS(r0, r1, r2, r3);
    field[0] = r0, field[1] = r1, field[2] = r2, field[3] = r3;
  }
  static Double gather(const double* p, const std::uint32_t* index) noexcept {
    return _mm_setr_pd(p[index[0]], p[index[1]]);
  }
  static Words gather(const std::uint32_t* p, const std::uint32_t* index) noexcept {
    const auto at = [=](std::size_t i) { return static_cast<int>(p[index[i]]); };
    return _mm_setr_epi32(at(0), at(1), at(2), at(3));
  }
  static Float rounded(const Double (&v)[2]) noexcept {
    return _mm_movelh_ps(_mm_cvtpd_ps(v[0]), _mm_cvtpd_ps(v[1]));
  }
  static void widened(Float v, Double (&to)[2]) noexcept {
    to[0] = _mm_cvtps_pd(v), to[1] = _mm_cvtps_pd(_mm_movehl_ps(v, v));
  }
  static std::uint32_t bits(xsimd::batch_bool<float, xsimd::sse2> hits) noexcept {
    return static_cast<std::uint32_t>(_mm_movemask_ps(hits));
  }
  static float least(Float values) noexcept {
    const __m128 pairs = _mm_min_ps(values, _mm_movehl_ps(values, values));
    return _mm_cvtss_f32(_mm_min_ss(pairs, _mm_shuffle_ps(pairs, pairs, 1)));
  }
  static constexpr float rough = 0x1p-11f;
  static Float rough_root(Float x) noexcept { return x * Float(_mm_rsqrt_ps(x)); }
};

}  // namespace

extern const Kernels sse2_kernels;
constinit const Kernels sse2_kernels = Row<Sse2Lanes>::kernels;

}  // namespace bch::detail
