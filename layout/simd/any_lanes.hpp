// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "layout/base/plain_arithmetic.hpp"
#include "layout/simd/batches.hpp"

namespace bch::detail {

/// A table over the sets of four bits: the numbers of the bits that are set, 16 bits each from the lowest,
/// and how many there are. (It is not a member, because members of a template would be data that objects
/// share.)
constexpr std::uint64_t numbers_of_set[] = {
    0x0, 0x0,      0x1,      0x1'0000,      0x2,      0x2'0000,      0x2'0001,      0x2'0001'0000,
    0x3, 0x3'0000, 0x3'0001, 0x3'0001'0000, 0x3'0002, 0x3'0002'0000, 0x3'0002'0001, 0x3'0002'0001'0000};
constexpr std::uint64_t counts_of_set = 0x4332'3221'3221'2110;

/// Provides the vocabulary of SIMD, for any instruction set that xsimd knows: its batches with its functions (+, max, sqrt ...)
/// and what stands here because xsimd 8.1 has no name for it. x86.hpp replaces what x86-64 has instructions for.
/// `Own`: the type that derives from this. One of a file's anonymous namespace keeps other files from sharing what was
/// compiled for that file's registers.
template <class Arch, class Own>
struct AnyLanes {
  template <class T>
  using Batch = xsimd::batch<T, Arch>;
  using Float = Batch<float>;
  using Double = Batch<double>;
  using Ints = Batch<std::int32_t>;
  using Words = Batch<std::uint32_t>;
  using Mask = xsimd::batch_bool<float, Arch>;
  static constexpr unsigned width = Float::size, doubles = Double::size;

  /// Leaves the processor's registers as callers expect them, at the end.
  struct Guard {};

  template <class T>
  static Batch<T> load(const T* p) noexcept {
    return Batch<T>::load_unaligned(p);
  }
  template <class T>
  static void store(T* p, Batch<T> v) noexcept {
    v.store_unaligned(p);
  }
  static Float select(Mask mask, Float yes, Float no) noexcept { return xsimd::select(mask, yes, no); }

  /// Returns the first where it is less (or more) than the second, which alone may be NaN in the result.
  static Float min(Float first, Float second) noexcept { return select(first < second, first, second); }
  static Float max(Float first, Float second) noexcept { return select(second < first, first, second); }

  /// Returns NaN in the lanes that are set, and 0 in those that are not; the other lanes stay.
  static Float nan_where(Mask mask, Float v) noexcept { return select(mask, Float(__builtin_nanf("")), v); }
  static Float zero_unless(Mask mask, Float v) noexcept { return select(mask, v, Float(0.0f)); }

  /// Returns one lane of floats or doubles.
  template <class T>
  static T lane(Batch<T> v, unsigned i) noexcept {
    return v.data[i];
  }
  /// Returns a register of these lanes.
  template <class T, class... Lane>
  [[gnu::always_inline]] static Batch<T> of(Lane... lane) noexcept {
    typedef T Vector __attribute__((vector_size(sizeof(Batch<T>))));
    return Batch<T>((typename Batch<T>::register_type)Vector{lane...});
  }
  /// Returns what `p` has at each index, without a way through memory.
  template <class T>
  static Batch<T> gather(const T* p, const std::uint32_t* index) noexcept {
    return gather(p, index, std::make_index_sequence<Batch<T>::size>());
  }

  /// Picks these of each group of four lanes: 0 to 3 from the first, 4 to 7 from the second.
  template <unsigned... which>
  static Float shuffle(Float first, Float second) noexcept {
    return [=]<std::size_t... lane>(std::index_sequence<lane...>) {
      constexpr unsigned four[] = {which...};
      using Register = typename Float::register_type;
      return Float(
          __builtin_shufflevector(Register(first), Register(second),
                                  lane / 4 * 4 + four[lane % 4] % 4 + four[lane % 4] / 4 * width...));
    }
    (std::make_index_sequence<width>());
  }
  /// Transposes each group of four lanes: the first ones of all four registers, then the second ones ...
  static void transpose(const Float (&from)[4], Float (&to)[4]) noexcept {
    const Float low01 = shuffle<0, 4, 1, 5>(from[0], from[1]), low23 = shuffle<0, 4, 1, 5>(from[2], from[3]),
                high01 = shuffle<2, 6, 3, 7>(from[0], from[1]),
                high23 = shuffle<2, 6, 3, 7>(from[2], from[3]);
    to[0] = shuffle<0, 1, 4, 5>(low01, low23), to[1] = shuffle<2, 3, 6, 7>(low01, low23);
    to[2] = shuffle<0, 1, 4, 5>(high01, high23), to[3] = shuffle<2, 3, 6, 7>(high01, high23);
  }

  /// Loads the first and the second ones of pairs of floats (or of what has their size), lane = pair: at(lane) points to one.
  template <class At>
  static void load_pairs(At at, Float& first, Float& second) noexcept {
    const auto half = [&]<std::size_t... i>(std::size_t from, std::index_sequence<i...>) {
      return xsimd::bitwise_cast<Float>(of<double>(pair(at(4 * (i / 2) + i % 2 + from))...));
    };
    const Float low = half(0, std::make_index_sequence<doubles>()),
                high = half(2, std::make_index_sequence<doubles>());
    first = shuffle<0, 2, 4, 6>(low, high), second = shuffle<1, 3, 5, 7>(low, high);
  }
  /// Loads the same, as doubles.
  template <class At>
  static void load_pairs(At at, Double (&to)[2]) noexcept {
    static_assert(doubles == 2);
    const auto both = xsimd::bitwise_cast<Float>(of<double>(pair(at(0)), pair(at(1))));
    Own::to_double(shuffle<0, 2, 1, 3>(both, both), to);
  }

  /// Returns four floats for each group of four lanes: those where at(group) points.
  template <class At>
  [[gnu::always_inline]] static Float broadcast_quads(At at) noexcept {
    return load(at(0));
  }
  /// Loads field after field of records of four floats, lane = record. They are picked from a table, each by an index of
  /// strides from its beginning.
  template <std::size_t stride>
  [[gnu::always_inline]] static void load_records(const float* table, const std::uint32_t* index,
                                                  Float (&field)[4]) noexcept {
    Float record[4];
#pragma GCC unroll 4
    for (std::size_t i = 0; i < 4; ++i)
      record[i] =
          Own::broadcast_quads([=](std::size_t group) { return table + stride * index[4 * group + i]; });
    transpose(record, field);
  }

  /// Loads the same of records of four integers, as doubles.
  template <std::size_t stride>
  static void load_integers(const std::int32_t* table, const std::uint32_t* index,
                            Double (&field)[4]) noexcept {
    for (std::size_t i = 0; i < 4; ++i) {
      double lane[doubles];
      for (std::size_t k = 0; k < doubles; ++k) lane[k] = table[stride * index[k] + i];
      field[i] = load(lane);
    }
  }

  /// Returns the bits of the lanes that are set.
  template <class T>
  static std::uint32_t bits(xsimd::batch_bool<T, Arch> mask) noexcept {
#if defined(__wasm_simd128__)
    if constexpr (sizeof(T) == 4) return __builtin_wasm_bitmask_i32x4(mask.data);
#endif
    bool lane[Batch<T>::size];
    mask.store_unaligned(lane);
    std::uint32_t set = 0;
    for (std::size_t i = 0; i < Batch<T>::size; ++i) set |= std::uint32_t{lane[i]} << i;
    return set;
  }
  /// Returns how many bits are set, of the lowest 16.
  static std::size_t count(std::uint32_t bits) noexcept {
    return static_cast<std::size_t>(__builtin_popcount(bits));
  }
  /// Returns the least lane.
  static float least(Float values) noexcept {
    float result = lane(values, 0);
    for (unsigned i = 1; i < width; ++i) result = lane(values, i) < result ? lane(values, i) : result;
    return result;
  }

  /// Returns a register of floats from as many doubles, and back.
  static Float to_float(const Double (&v)[2]) noexcept {
    float to[width];
    for (unsigned i = 0; i < width; ++i) to[i] = static_cast<float>(lane(v[i / doubles], i % doubles));
    return load(to);
  }
  static void to_double(Float v, Double (&to)[2]) noexcept {
    double wide[width];
    for (unsigned i = 0; i < width; ++i) wide[i] = static_cast<double>(lane(v, i));
    to[0] = load(wide), to[1] = load(wide + doubles);
  }

  /// Returns a register of doubles from as many floats.
  static Double wide(const float* p) noexcept {
    double lane[doubles];
    for (unsigned i = 0; i < doubles; ++i) lane[i] = static_cast<double>(p[i]);
    return load(lane);
  }

  /// Returns the square root, for bounds: it is off by less than 3/4 of `rough`, relatively, for normal numbers, differently on
  /// every processor, and NaN for numbers below 0.
  static Float approximate_sqrt(Float x) noexcept {
    return xsimd::sqrt(x);
  }
  static constexpr float approximation_error = 0x1p-23f;

  /// Writes first + i for every set bit i, in order; a register's lanes of numbers may be written.
  /// Returns: how many.
  static std::uint32_t compress_indices(std::uint32_t bits, std::uint32_t first, std::uint16_t* to) noexcept {
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < width; i += 4) {
      const std::uint32_t four = bits >> i & 15;
      const std::uint64_t numbers = numbers_of_set[four] + 0x1'0001'0001'0001 * (first + i);
      __builtin_memcpy(to + count, &numbers, sizeof numbers);
      count += static_cast<std::uint32_t>(counts_of_set >> 4 * four & 15);
    }
    return count;
  }

  // Of an outer product of blocks of eight or four, `row` gives part of the left side (disc i, or discs i and i + 1 where
  // two rows fit), `columns` the matching right side.

  static const float* load_eight(const float* p) noexcept {
    return p;
  }
  template <unsigned count>
  static Float row(const float* eight, unsigned i) noexcept {
    static_assert(width <= count, "or else a row of its own");
    return Float(eight[i]);
  }
  template <unsigned count>
  static Float columns(const float* eight, unsigned part) noexcept {
    return load(eight + part * width);
  }

  /// Represents a pair of floats, or of what has their size: their eight bytes.
  typedef double Pair __attribute__((may_alias, aligned(4)));
  static double pair(const void* p) noexcept {
    return *static_cast<const Pair*>(p);
  }
  /// Stores lanes 2 i and 2 i + 1.
  static void store_pair(void* p, Float v, unsigned i) noexcept {
    *static_cast<Pair*>(p) = lane(xsimd::bitwise_cast<Double>(v), i);
  }

 private:
  template <class T, std::size_t... lane>
  [[gnu::always_inline]] static Batch<T> gather(const T* p, const std::uint32_t* index,
                                                std::index_sequence<lane...>) noexcept {
    return of<T>(p[index[lane]]...);
  }
};

/// Provides AnyLanes, or the lanes of the instruction set.
template <class Arch, class Own>
struct Lanes : AnyLanes<Arch, Own> {};

}  // namespace bch::detail
