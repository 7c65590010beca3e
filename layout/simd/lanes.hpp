// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "layout/base/processor.hpp"
#include "layout/simd/any_lanes.hpp"
#if BCH_X86
#include "layout/simd/x86.hpp"
#endif

namespace bch::detail {

/// Selects one lane: plain float and double.
struct Scalar {};

template <class Own>
struct Lanes<Scalar, Own> {
  using Float = float;
  using Double = double;
  using Words = std::uint32_t;
  using Mask = bool;
  static constexpr unsigned width = 1, doubles = 1;

  // These copy, as registers do: what is stored as a float may be kept and read as an integer.
  static Float load(const float* p) noexcept {
    Float value;
    __builtin_memcpy(&value, p, sizeof value);
    return value;
  }
  static Double load(const double* p) noexcept { return *p; }
  static Double wide(const float* p) noexcept { return static_cast<double>(load(p)); }
  static void store(float* p, Float v) noexcept { __builtin_memcpy(p, &v, sizeof v); }
  static void store(double* p, Double v) noexcept { *p = v; }
  static void store(std::uint32_t* p, Words v) noexcept { *p = v; }
  static Float select(Mask mask, Float yes, Float no) noexcept { return mask ? yes : no; }
  template <std::size_t stride>
  static void load_records(const float* table, const std::uint32_t* index, Float (&field)[4]) noexcept {
    for (std::size_t i = 0; i < 4; ++i) field[i] = load(table + stride * *index + i);
  }
  static std::uint32_t compress_indices(std::uint32_t bits, std::uint32_t first, std::uint16_t* to) noexcept {
    *to = static_cast<std::uint16_t>(first);
    return bits & 1;
  }
  static const float* load_eight(const float* p) noexcept { return p; }
  template <unsigned count>
  static Float row(const float* eight, unsigned i) noexcept {
    return eight[i];
  }
  template <unsigned count>
  static Float columns(const float* eight, unsigned part) noexcept {
    return eight[part];
  }
};

/// Holds the lanes of registers that every processor has.
struct BaseLanes : Lanes<BaseArch, BaseLanes> {};

/// Calls each(k) for k below a count of whole registers, so that the compiler sees how many a register has
/// and adds no loops for what it does not fill: those take longer than all of a small batch.
template <class Simd, class Each>
[[gnu::always_inline]] inline void for_whole_registers(std::uint32_t count, Each each) noexcept {
  for (std::uint32_t k = 0; k < count; k += Simd::width)
    for (std::uint32_t lane = 0; lane < Simd::width; ++lane) each(k + lane);
}

/// Returns sqrt(x), x >= 0, nearly: as Simd's approximate_sqrt(), of what is less than the least normal number that of
/// this.
template <class Simd>
typename Simd::Float approximate_sqrt(typename Simd::Float x) noexcept {
  return Simd::approximate_sqrt(xsimd::max(x, typename Simd::Float(0x1p-126f)));
}

}  // namespace bch::detail
