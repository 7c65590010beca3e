// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/simd/transform.hpp"
#include "layout/format/shape_set_view.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Returns the bits of the lanes in which discs a and b overlap, touching included.
template <class Simd, class Float = typename Simd::Float>
std::uint32_t overlaps(Float bx, Float by, Float br, Float ax, Float ay, Float ar) noexcept {
  const Float x = bx - ax, y = by - ay, r = ar + br;
  return Simd::bits(x * x + y * y <= r * r);
}

/// Holds the location of eight discs: their x, and the distance in floats to each y and radius. The functions are
/// always inlined, so that instruction sets share no function.
struct Discs {
  const float* x;
  std::size_t to_y, to_radius;

  [[gnu::always_inline]] const float* y() const noexcept { return x + to_y; }
  [[gnu::always_inline]] const float* radius() const noexcept { return x + to_radius; }
};

/// Masks over the pairs of eight discs of A and eight of B, where bit 8 i + j stands for disc i of A and disc j of B:
/// all pairs with A's first disc, and all pairs with B's first disc.
constexpr std::uint64_t first_row_of_pairs = 0xff, first_column_of_pairs = 0x0101010101010101;

/// The number of pairs of discs of two blocks.
constexpr unsigned block_pairs = block_width * block_width;

template <class Simd, unsigned count, class Visit>
void visit_pairs_called(const Transform& b_in_a, Discs a, Discs b, Visit visit) noexcept;

/// Calls visit(k, x, y, r) for every register of pairs of the first `count` (4 or 8) discs of A and of B. Its lanes
/// are the pairs from number k on. Disc i of A and disc j of B are the pair with the number `count * i + j`. (x, y)
/// leads from A's disc to B's in A's frame, r is the sum of radii. The operations are those of
/// layout/base/rounding.hpp. Padding gives infinities and NaN. It is inlined because a call takes longer than a test.
/// With a width of 1 it is not, because its copies would fill the object file.
template <class Simd, unsigned count = block_width, bool called = Simd::width == 1, class Visit>
[[gnu::always_inline]] inline void visit_disc_pairs(const Transform& b_in_a, Discs a, Discs b,
                                                    Visit visit) noexcept {
  if constexpr (called) return visit_pairs_called<Simd, count>(b_in_a, a, b, visit);
  using Float = typename Simd::Float;
  constexpr unsigned parts = Simd::width < count ? count / Simd::width : 1;
  constexpr unsigned rows = Simd::width > count ? Simd::width / count : 1;
  const auto placed = b_in_a.in_lanes<Float>();
  const auto ax = Simd::load_eight(a.x), ay = Simd::load_eight(a.y()), ar = Simd::load_eight(a.radius());
  Float bx[parts], by[parts], br[parts];
#pragma GCC unroll 8
  for (unsigned part = 0; part < parts; ++part) {
    const auto [x, y] =
        placed.apply(Simd::template columns<count>(b.x, part), Simd::template columns<count>(b.y(), part));
    bx[part] = x, by[part] = y, br[part] = Simd::template columns<count>(b.radius(), part);
  }
#pragma GCC unroll 8
  for (unsigned row = 0; row < count; row += rows) {
    const Float row_x = Simd::template row<count>(ax, row), row_y = Simd::template row<count>(ay, row),
                row_r = Simd::template row<count>(ar, row);
#pragma GCC unroll 8
    for (unsigned part = 0; part < parts; ++part)
      visit(row * count + part * Simd::width, bx[part] - row_x, by[part] - row_y, row_r + br[part]);
  }
}

template <class Simd, unsigned count, class Visit>
[[gnu::noinline]] void visit_pairs_called(const Transform& b_in_a, Discs a, Discs b, Visit visit) noexcept {
  visit_disc_pairs<Simd, count, false>(b_in_a, a, b, visit);
}

/// Returns the bits of those pairs whose gap, with radii times `factor`, is at most `gap`; see Gaps.
template <class Simd, unsigned count = block_width>
[[gnu::always_inline]] inline std::uint64_t near_discs(const Transform& b_in_a, Discs a, Discs b,
                                                       float factor, float gap) noexcept {
  using Float = typename Simd::Float;
  std::uint64_t bits = 0;
  visit_disc_pairs<Simd, count>(b_in_a, a, b, [&bits, factor, gap](unsigned k, Float x, Float y, Float r) {
    const Float sum = r * Float(factor) + Float(gap);
    bits |= std::uint64_t{Simd::bits(x * x + y * y <= sum * sum)} << k;
  });
  return bits;
}

/// Returns the bits of those pairs that overlap, touching included: bit k for pair k.
template <class Simd, unsigned count = block_width>
[[gnu::always_inline]] inline std::uint64_t overlapping_discs(const Transform& b_in_a, Discs a,
                                                              Discs b) noexcept {
  using Float = typename Simd::Float;
  std::uint64_t bits = 0;
  visit_disc_pairs<Simd, count>(b_in_a, a, b, [&bits](unsigned k, Float x, Float y, Float r) {
    bits |= std::uint64_t{Simd::bits(x * x + y * y <= r * r)} << k;
  });
  return bits;
}

/// Holds (x, y, r) of one of those pairs, by the same operations.
struct PlacedPair {
  float x, y, r;
};
template <class Simd>
[[gnu::always_inline]] inline PlacedPair disc_pair(const Transform& b_in_a, Discs a, Discs b,
                                                   unsigned pair) noexcept {
  const unsigned i = pair / block_width, j = pair % block_width;
  const auto [x, y] = b_in_a.apply(b.x[j], b.y()[j]);
  return {x - a.x[i], y - a.y()[i], a.radius()[i] + b.radius()[j]};
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

/// Returns the bits of the pairs whose values are at most `limit`.
template <class Simd>
std::uint64_t all_within(const float* values, float limit) noexcept {
  using Float = typename Simd::Float;
  std::uint64_t bits = 0;
#pragma GCC unroll 16
  for (unsigned k = 0; k < block_pairs; k += Simd::width)
    bits |= std::uint64_t{Simd::bits(Simd::load(values + k) <= Float(limit))} << k;
  return bits;
}

/// Returns the first pair whose value is at most `limit`. Precondition: there is one.
template <class Simd>
unsigned first_within(const float* values, float limit) noexcept {
  return static_cast<unsigned>(__builtin_ctzll(all_within<Simd>(values, limit)));
}

}  // namespace bch::detail
