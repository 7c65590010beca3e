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

template <class Simd, unsigned count>
[[gnu::noinline]] bool balls_overlap_called(const SpaceTransformOf<float>& b_in_a, Balls a, Balls b) noexcept;

/// Returns whether some of `count` spheres of A, four or eight, overlaps some of as many of B.
template <class Simd, unsigned count, bool called = Simd::width == 1>
[[gnu::always_inline]] inline bool balls_overlap(const SpaceTransformOf<float>& b_in_a, Balls a,
                                                 Balls b) noexcept {
  if constexpr (called) return balls_overlap_called<Simd, count>(b_in_a, a, b);
  using Float = typename Simd::Float;
  constexpr unsigned parts = Simd::width < count ? count / Simd::width : 1;
  constexpr unsigned rows = Simd::width > count ? Simd::width / count : 1;
  const SpaceTransformOf<Float> to_a{b_in_a.ground.template in_lanes<Float>(), Float(b_in_a.tz)};
  const auto ax = Simd::eight(a.field(0)), ay = Simd::eight(a.field(1)), az = Simd::eight(a.field(2)),
             ar = Simd::eight(a.field(3));
  SpheresOf<Float> column[parts];
#pragma GCC unroll 8
  for (unsigned part = 0; part < parts; ++part)
    column[part] = placed<Float>(
        to_a,
        {Simd::template columns<count>(b.field(0), part), Simd::template columns<count>(b.field(1), part),
         Simd::template columns<count>(b.field(2), part), Simd::template columns<count>(b.field(3), part)});
  auto any = Float(1.0f) < Float(0.0f);
#pragma GCC unroll 8
  for (unsigned i = 0; i < count; i += rows) {
    const SpheresOf<Float> row{Simd::template row<count>(ax, i), Simd::template row<count>(ay, i),
                               Simd::template row<count>(az, i), Simd::template row<count>(ar, i)};
#pragma GCC unroll 8
    for (unsigned part = 0; part < parts; ++part) any = any | spheres_overlap(row, column[part]);
  }
  return Simd::bits(any) != 0;
}

template <class Simd, unsigned count>
bool balls_overlap_called(const SpaceTransformOf<float>& b_in_a, Balls a, Balls b) noexcept {
  return balls_overlap<Simd, count, false>(b_in_a, a, b);
}

}  // namespace bch::detail
