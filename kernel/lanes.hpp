// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <xsimd/xsimd.hpp>

namespace bch::kernel {

/// What the pair kernel needs of an instruction set beyond arithmetic. Eight is the width of a block: `row`
/// gives part of an outer product's left side (disc i, or discs i and i + 1 where two rows fit), `columns`
/// the matching right side. Each instruction set's file adds bits(), for which xsimd 8.1 has no name.
template <class Arch>
struct Lanes {
  using Float = xsimd::batch<float, Arch>;
  using Double = xsimd::batch<double, Arch>;
  using Mask = xsimd::batch_bool<float, Arch>;
  static constexpr unsigned width = Float::size;

  static Float load(const float* p) noexcept { return Float::load_unaligned(p); }
  static Double load(const double* p) noexcept { return Double::load_unaligned(p); }
  static void store(float* p, Float v) noexcept { v.store_unaligned(p); }
  static void store(double* p, Double v) noexcept { v.store_unaligned(p); }
  static Float select(Mask mask, Float yes, Float no) noexcept { return xsimd::select(mask, yes, no); }
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
  using Mask = bool;
  static constexpr unsigned width = 1;

  static Float load(const float* p) noexcept { return *p; }
  static Double load(const double* p) noexcept { return *p; }
  static void store(float* p, Float v) noexcept { *p = v; }
  static void store(double* p, Double v) noexcept { *p = v; }
  static Float select(Mask mask, Float yes, Float no) noexcept { return mask ? yes : no; }
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

}  // namespace bch::kernel
