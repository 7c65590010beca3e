// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Maps from B's frame into A's: a rotation (c, s), then a translation. See layout/base/rounding.hpp.
struct Transform {
  float c, s, tx, ty;
};

/// Bits of the lanes in which discs a and b overlap, touching included.
template <class Simd, class Float = typename Simd::Float>
std::uint32_t overlaps(Float bx, Float by, Float br, Float ax, Float ay, Float ar) noexcept {
  const Float x = bx - ax, y = by - ay, r = ar + br;
  return Simd::bits(x * x + y * y <= r * r);
}

/// The location of eight discs: their x, and the distance in floats to each y and radius. The functions are
/// always inlined, so that instruction sets share no function.
struct Discs {
  const float* x;
  std::size_t to_y, to_radius;

  [[gnu::always_inline]] const float* y() const noexcept { return x + to_y; }
  [[gnu::always_inline]] const float* radius() const noexcept { return x + to_radius; }
};

/// Bits of pairs of eight discs by eight, bit 8 i + j for disc i of A and j of B: those of A's first, and of
/// B's.
constexpr std::uint64_t first_row_of_pairs = 0xff, first_column_of_pairs = 0x0101010101010101;

template <class Simd, unsigned count>
std::uint64_t overlaps_called(const Transform& b_in_a, Discs a, Discs b) noexcept;

/// The first `count` of A's discs against those of B, four or all eight: bit count * i + j for disc i of A
/// and j of B.
/// Inlined: passing it to a function takes longer than the test, but not one lane at a time, when copies of
/// it would fill the object.
template <class Simd, unsigned count = block_width, bool called = Simd::width == 1>
[[gnu::always_inline]] inline std::uint64_t overlapping_discs(const Transform& b_in_a, Discs a,
                                                              Discs b) noexcept {
  if constexpr (called) return overlaps_called<Simd, count>(b_in_a, a, b);
  using Float = typename Simd::Float;
  constexpr unsigned parts = Simd::width < count ? count / Simd::width : 1;
  constexpr unsigned rows = Simd::width > count ? Simd::width / count : 1;
  const Float c(b_in_a.c), s(b_in_a.s), tx(b_in_a.tx), ty(b_in_a.ty);
  const auto ax = Simd::eight(a.x), ay = Simd::eight(a.y()), ar = Simd::eight(a.radius());
  Float px[parts], py[parts], r[parts];
#pragma GCC unroll 8
  for (unsigned part = 0; part < parts; ++part) {
    const Float x = Simd::template columns<count>(b.x, part), y = Simd::template columns<count>(b.y(), part);
    px[part] = tx + (c * x - s * y), py[part] = ty + (s * x + c * y);
    r[part] = Simd::template columns<count>(b.radius(), part);
  }
  std::uint64_t bits = 0;
#pragma GCC unroll 8
  for (unsigned row = 0; row < count; row += rows) {
    const Float row_x = Simd::template row<count>(ax, row), row_y = Simd::template row<count>(ay, row),
                row_r = Simd::template row<count>(ar, row);
#pragma GCC unroll 8
    for (unsigned part = 0; part < parts; ++part)
      bits |= std::uint64_t{overlaps<Simd>(px[part], py[part], r[part], row_x, row_y, row_r)}
              << (row * count + part * Simd::width);
  }
  return bits;
}

template <class Simd, unsigned count>
[[gnu::noinline]] std::uint64_t overlaps_called(const Transform& b_in_a, Discs a, Discs b) noexcept {
  return overlapping_discs<Simd, count, false>(b_in_a, a, b);
}

}  // namespace bch::detail
