// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "kernel/simd/block_test.hpp"
#include "kernel/simd/lanes.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Pairs of discs of two blocks.
constexpr unsigned block_pairs = block_width * block_width;

template <class Simd, class Visit>
void visit_pairs_called(const Transform& b_in_a, Discs a, Discs b, Visit visit) noexcept;

/// Visits the pairs of A's eight discs with B's eight, pair 8 i + j for disc i of A and j of B: calls
/// visit(k, x, y, r) for every register, whose lanes are the pairs from k on. (x, y) leads from A's disc to
/// B's in A's frame, r is the sum of radii. The operations are those of layout/base/rounding.hpp. Padding
/// gives infinities and NaN. One lane at a time, inlined copies of it would fill the object file.
template <class Simd, bool called = Simd::width == 1, class Visit>
[[gnu::always_inline]] inline void visit_disc_pairs(const Transform& b_in_a, Discs a, Discs b,
                                                    Visit visit) noexcept {
  if constexpr (called) return visit_pairs_called<Simd>(b_in_a, a, b, visit);
  using Float = typename Simd::Float;
  constexpr unsigned parts = Simd::width < block_width ? block_width / Simd::width : 1;
  constexpr unsigned rows = Simd::width > block_width ? Simd::width / block_width : 1;
  const Float c(b_in_a.c), s(b_in_a.s), tx(b_in_a.tx), ty(b_in_a.ty);
  const auto ax = Simd::eight(a.x), ay = Simd::eight(a.y()), ar = Simd::eight(a.radius());
  Float px[parts], py[parts], r[parts];
#pragma GCC unroll 8
  for (unsigned part = 0; part < parts; ++part) {
    const Float x = Simd::template columns<block_width>(b.x, part),
                y = Simd::template columns<block_width>(b.y(), part);
    px[part] = tx + (c * x - s * y), py[part] = ty + (s * x + c * y);
    r[part] = Simd::template columns<block_width>(b.radius(), part);
  }
#pragma GCC unroll 8
  for (unsigned row = 0; row < block_width; row += rows) {
    const Float row_x = Simd::template row<block_width>(ax, row),
                row_y = Simd::template row<block_width>(ay, row),
                row_r = Simd::template row<block_width>(ar, row);
#pragma GCC unroll 8
    for (unsigned part = 0; part < parts; ++part)
      visit(row * block_width + part * Simd::width, px[part] - row_x, py[part] - row_y, row_r + r[part]);
  }
}

/// One of those pairs, by the same operations.
struct PlacedPair {
  float x, y, r;
};
template <class Simd>
[[gnu::always_inline]] inline PlacedPair disc_pair(const Transform& b_in_a, Discs a, Discs b,
                                                   unsigned pair) noexcept {
  const unsigned i = pair / block_width, j = pair % block_width;
  const float x = b.x[j], y = b.y()[j];
  return {b_in_a.tx + (b_in_a.c * x - b_in_a.s * y) - a.x[i],
          b_in_a.ty + (b_in_a.s * x + b_in_a.c * y) - a.y()[i], a.radius()[i] + b.radius()[j]};
}

/// Returns the least of the pairs' values.
template <class Simd>
float least_value(const float* values) noexcept {
  auto least = Simd::load(values);
#pragma GCC unroll 16
  for (unsigned k = Simd::width; k < block_pairs; k += Simd::width)
    least = xsimd::min(least, Simd::load(values + k));
  return Simd::least(least);
}

template <class Simd, class Visit>
[[gnu::noinline]] void visit_pairs_called(const Transform& b_in_a, Discs a, Discs b, Visit visit) noexcept {
  visit_disc_pairs<Simd, false>(b_in_a, a, b, visit);
}

/// The pairs whose values are at most so much.
template <class Simd>
std::uint64_t all_within(const float* values, float most) noexcept {
  using Float = typename Simd::Float;
  std::uint64_t bits = 0;
#pragma GCC unroll 16
  for (unsigned k = 0; k < block_pairs; k += Simd::width)
    bits |= std::uint64_t{Simd::bits(Simd::load(values + k) <= Float(most))} << k;
  return bits;
}

/// The first of them. Precondition: there is one.
template <class Simd>
unsigned first_within(const float* values, float most) noexcept {
  return static_cast<unsigned>(__builtin_ctzll(all_within<Simd>(values, most)));
}

}  // namespace bch::detail
