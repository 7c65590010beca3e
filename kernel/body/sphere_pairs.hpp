// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/body/sphere_test.hpp"
#include "layout/body/body_record.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Holds the location of spheres side by side: their x, and the distance in floats to each y, z and radius.
struct Balls {
  const float* x;
  std::size_t stride;

  [[gnu::always_inline]] Balls from(unsigned i) const noexcept { return {x + i, stride}; }
  [[gnu::always_inline]] const float* field(unsigned i) const noexcept { return x + i * stride; }
};

/// Returns the core spheres of a record, from one of them on.
[[gnu::always_inline]] inline Balls core_of(const float* record, unsigned first) noexcept {
  return {record + record_core + first, core_spheres};
}

/// Returns the spheres of a leaf.
[[gnu::always_inline]] inline Balls balls_of(const float* record, std::uint32_t leaf) noexcept {
  return {leaf_of(record, leaf), header_of(record).leaf_size};
}

template <class Simd, unsigned count, class Visit>
[[gnu::noinline]] void visit_ball_pairs_called(const SpaceTransformOf<float>& b_in_a, Balls a, Balls b,
                                               Visit visit) noexcept;

/// Visits the pairs of `count` spheres of A, four or eight, with as many of B, pair count * i + j for sphere i of A and j of B: calls
/// visit(k, spheres of A, spheres of B in A's frame) for every register, whose lanes are the pairs from k on.
template <class Simd, unsigned count, bool called = Simd::width == 1, class Visit>
[[gnu::always_inline]] inline void visit_ball_pairs(const SpaceTransformOf<float>& b_in_a, Balls a, Balls b,
                                                    Visit visit) noexcept {
  if constexpr (called) return visit_ball_pairs_called<Simd, count>(b_in_a, a, b, visit);
  using Float = typename Simd::Float;
  constexpr unsigned parts = Simd::width < count ? count / Simd::width : 1;
  constexpr unsigned rows = Simd::width > count ? Simd::width / count : 1;
  const SpaceTransformOf<Float> to_a{b_in_a.ground.template in_lanes<Float>(), Float(b_in_a.tz)};
  const auto ax = Simd::load_eight(a.field(0)), ay = Simd::load_eight(a.field(1)),
             az = Simd::load_eight(a.field(2)), ar = Simd::load_eight(a.field(3));
  SpheresOf<Float> column[parts];
#pragma GCC unroll 8
  for (unsigned part = 0; part < parts; ++part)
    column[part] = placed<Float>(
        to_a,
        {Simd::template columns<count>(b.field(0), part), Simd::template columns<count>(b.field(1), part),
         Simd::template columns<count>(b.field(2), part), Simd::template columns<count>(b.field(3), part)});
#pragma GCC unroll 8
  for (unsigned i = 0; i < count; i += rows) {
    const SpheresOf<Float> row{Simd::template row<count>(ax, i), Simd::template row<count>(ay, i),
                               Simd::template row<count>(az, i), Simd::template row<count>(ar, i)};
#pragma GCC unroll 8
    for (unsigned part = 0; part < parts; ++part) visit(i * count + part * Simd::width, row, column[part]);
  }
}

template <class Simd, unsigned count, class Visit>
void visit_ball_pairs_called(const SpaceTransformOf<float>& b_in_a, Balls a, Balls b, Visit visit) noexcept {
  visit_ball_pairs<Simd, count, false>(b_in_a, a, b, visit);
}

/// Returns whether some of these pairs meet: are apart by at most a gap.
template <class Simd, unsigned count>
[[gnu::always_inline]] inline bool balls_meet(const SpaceTransformOf<float>& b_in_a, Balls a, Balls b,
                                              float gap) noexcept {
  using Float = typename Simd::Float;
  auto any = Float(1.0f) < Float(0.0f);
  visit_ball_pairs<Simd, count>(
      b_in_a, a, b, [&any, gap](unsigned, const SpheresOf<Float>& of_a, const SpheresOf<Float>& of_b) {
        any = any | spheres_meet(of_a, of_b, Float(gap));
      });
  return Simd::bits(any) != 0;
}

/// Calls visit.operator()<count>(i, j) for the spheres of two leaves, block by block of `count` spheres, from i and j on, until one
/// returns true; and returns whether one did.
template <class Visit>
[[gnu::always_inline]] inline bool visit_blocks(Balls a, Balls b, Visit visit) noexcept {
  if (a.stride + b.stride == 8) [[likely]]
    return visit.template operator()<4>(0, 0);
  if (a.stride == 8 && b.stride == 8) return visit.template operator()<8>(0, 0);
  for (unsigned i = 0; i < a.stride; i += 4)
    for (unsigned j = 0; j < b.stride; j += 4)
      if (visit.template operator()<4>(i, j)) return true;
  return false;
}

}  // namespace bch::detail
