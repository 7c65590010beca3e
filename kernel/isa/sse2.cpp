// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/collide/pair_kernel.hpp"
#include "kernel/contact/contact_kernel.hpp"
#include "kernel/distance/clearance_kernel.hpp"
#include "kernel/distance/time_of_impact_kernel.hpp"
#include "kernel/penetration/extent_kernel.hpp"
#include "kernel/runtime/agent_check.hpp"

namespace bch::kernel {
namespace {

struct Sse2Lanes : Lanes<xsimd::sse2> {
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

bool check_sse2(const Arguments& arguments, std::size_t begin, std::size_t end) noexcept {
  return AgentCheck<Sse2Lanes>::passes(arguments, begin, end);
}

AgentRange named_sse2(const Pair* pairs, std::size_t begin, std::size_t end) noexcept {
  return AgentCheck<Sse2Lanes>::named(pairs, begin, end);
}

void run_sse2(const Arguments& arguments, std::size_t begin, std::size_t end) noexcept {
  PairKernel<Sse2Lanes>::run(arguments, begin, end);
}

bool run_if_valid_sse2(const Arguments& arguments, std::uint32_t count) noexcept {
  return PairKernel<Sse2Lanes>::run_if_valid(arguments, count);
}

void count_contacts_sse2(const Arguments& arguments, std::size_t begin, std::size_t end,
                         std::uint64_t* counts) noexcept {
  ContactKernel<Sse2Lanes>::count(arguments, begin, end, counts);
}

void fill_contacts_sse2(const Arguments& arguments, std::size_t begin, std::size_t end,
                        const std::uint64_t* offsets, DiscPair* contacts) noexcept {
  ContactKernel<Sse2Lanes>::fill(arguments, begin, end, offsets, contacts);
}

void extents_sse2(const CutDiscs& discs, const float* axis_x, const float* axis_y, std::uint32_t axes,
                  float* low, float* high) noexcept {
  ExtentKernel<Sse2Lanes>::run(discs, axis_x, axis_y, axes, low, high);
}

void clearance_sse2(const ClearanceArguments& arguments, std::size_t begin, std::size_t end) noexcept {
  ClearanceKernel<Sse2Lanes>::run(arguments, begin, end);
}

void time_of_impact_sse2(const TimeOfImpactArguments& arguments, std::size_t begin,
                         std::size_t end) noexcept {
  TimeOfImpactKernel<Sse2Lanes>::run(arguments, begin, end);
}

}  // namespace bch::kernel
