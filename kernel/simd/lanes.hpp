// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

namespace bch::detail {

/// Table over the sets of four bits: the numbers of the bits that are set, 16 bits each from the lowest, and
/// how many there are. (It is not a member, because members of a template would be data that objects share.)
constexpr std::uint64_t numbers_of_set[] = {
    0x0, 0x0,      0x1,      0x1'0000,      0x2,      0x2'0000,      0x2'0001,      0x2'0001'0000,
    0x3, 0x3'0000, 0x3'0001, 0x3'0001'0000, 0x3'0002, 0x3'0002'0000, 0x3'0002'0001, 0x3'0002'0001'0000};
constexpr std::uint64_t counts_of_set = 0x4332'3221'3221'2110;

/// The vocabulary of an instruction set, as far as xsimd has it. Eight is the width of a block: `row` gives part
/// of an outer product's left side (disc i, or discs i and i + 1 where two rows fit), `columns` the matching
/// right side. The file of each instruction set adds what xsimd 8.1 has no name for:
///
/// - Guard, whose destructor leaves the processor's registers as callers expect them;
/// - bits() of a mask, and least() of a register's lanes;
/// - gather() of doubles or words by index, without a way through memory;
/// - rounded(), which makes a register of floats of as many doubles, and widened(), its inverse;
/// - load_records(), which picks records of four floats from a table, each by an index of strides from its
///   beginning, and gives field after field, lane = record;
/// - rough_root(), for bounds: it is off by less than 3/4 of `rough`, relatively, for normal numbers, differently
///   on every processor, and NaN for numbers below 0.
template <class Arch>
struct Lanes {
  using Float = xsimd::batch<float, Arch>;
  using Double = xsimd::batch<double, Arch>;
  using Words = xsimd::batch<std::uint32_t, Arch>;
  using Mask = xsimd::batch_bool<float, Arch>;
  static constexpr unsigned width = Float::size, doubles = Double::size;

  static Float load(const float* p) noexcept { return Float::load_unaligned(p); }
  static Double load(const double* p) noexcept { return Double::load_unaligned(p); }
  static void store(float* p, Float v) noexcept { v.store_unaligned(p); }
  static void store(double* p, Double v) noexcept { v.store_unaligned(p); }
  static void store(std::uint32_t* p, Words v) noexcept { v.store_unaligned(p); }
  static Float select(Mask mask, Float yes, Float no) noexcept { return xsimd::select(mask, yes, no); }
  /// first + i for every set bit i, in order; a register's lanes of numbers may be written.
  /// Returns: how many.
  static std::uint32_t write_set(std::uint32_t bits, std::uint32_t first, std::uint16_t* to) noexcept {
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < width; i += 4) {
      const std::uint32_t four = bits >> i & 15;
      const std::uint64_t numbers = numbers_of_set[four] + 0x1'0001'0001'0001 * (first + i);
      __builtin_memcpy(to + count, &numbers, sizeof numbers);
      count += static_cast<std::uint32_t>(counts_of_set >> 4 * four & 15);
    }
    return count;
  }
  static const float* eight(const float* p) noexcept { return p; }
  template <unsigned count>
  static Float row(const float* eight, unsigned i) noexcept {
    static_assert(width <= count, "or else a row of its own");
    return Float(eight[i]);
  }
  template <unsigned count>
  static Float columns(const float* eight, unsigned part) noexcept {
    return Float::load_unaligned(eight + part * width);
  }
};

/// One lane: plain float and double.
struct Scalar {};

template <>
struct Lanes<Scalar> {
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
  static void store(float* p, Float v) noexcept { __builtin_memcpy(p, &v, sizeof v); }
  static void store(double* p, Double v) noexcept { *p = v; }
  static void store(std::uint32_t* p, Words v) noexcept { *p = v; }
  static Float select(Mask mask, Float yes, Float no) noexcept { return mask ? yes : no; }
  template <std::size_t stride>
  static void load_records(const float* table, const std::uint32_t* index, Float (&field)[4]) noexcept {
    for (std::size_t i = 0; i < 4; ++i) field[i] = load(table + stride * *index + i);
  }
  static std::uint32_t write_set(std::uint32_t bits, std::uint32_t first, std::uint16_t* to) noexcept {
    *to = static_cast<std::uint16_t>(first);
    return bits & 1;
  }
  static const float* eight(const float* p) noexcept { return p; }
  template <unsigned count>
  static Float row(const float* eight, unsigned i) noexcept {
    return eight[i];
  }
  template <unsigned count>
  static Float columns(const float* eight, unsigned part) noexcept {
    return eight[part];
  }
};

/// Calls each(k) for k below a count of whole registers, so that the compiler sees how many a register has
/// and adds no loops for what it does not fill: those take longer than all of a small batch.
template <class Simd, class Each>
[[gnu::always_inline]] inline void for_whole_registers(std::uint32_t count, Each each) noexcept {
  for (std::uint32_t k = 0; k < count; k += Simd::width)
    for (std::uint32_t lane = 0; lane < Simd::width; ++lane) each(k + lane);
}

/// sqrt(x), x >= 0, nearly: as Simd's rough_root(), of what is less than the least normal number that of
/// this.
template <class Simd>
typename Simd::Float rough_root(typename Simd::Float x) noexcept {
  return Simd::rough_root(xsimd::max(x, typename Simd::Float(0x1p-126f)));
}

}  // namespace bch::detail
