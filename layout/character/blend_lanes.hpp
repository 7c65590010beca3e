// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "layout/character/blend_loops.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Implements the loops of VertexBlend. A group of four lanes is a point; the lanes are x, y, z and 1 times a row of a map, and are added
/// up at the end, in one order for every instruction set.
template <class Simd>
class BlendLanes {
  using Float = typename Simd::Float;
  static constexpr unsigned pair = 8, points = Simd::width / 4;  ///< floats a pair; points a register
  static_assert(Simd::width == 4 || Simd::width == pair);

  /// Adds up all four lanes of each row. All lanes of the result are finite if the position is.
  static Float sums_of(Float x, Float y) noexcept {
    const Float halves = sum_of_halves(x, y);
    return Simd::template shuffle<0, 1, 0, 1>(halves, halves) +
           Simd::template shuffle<2, 3, 2, 3>(halves, halves);
  }
  static Float sums_of(Float x, Float y, Float z) noexcept {
    const Float xy = sum_of_halves(x, y), zz = z + Simd::template shuffle<2, 3, 2, 3>(z, z);
    return Simd::template shuffle<0, 1, 4, 5>(xy, zz) + Simd::template shuffle<2, 3, 5, 4>(xy, zz);
  }
  /// Lanes 0 and 2, and 1 and 3, of both.
  static Float sum_of_halves(Float x, Float y) noexcept {
    return Simd::template shuffle<0, 4, 1, 5>(x, y) + Simd::template shuffle<2, 6, 3, 7>(x, y);
  }

  /// Returns positions, by the rows of `bones` maps.
  template <unsigned axes>
  static Float positions(const float* maps, const std::uint32_t* first, const float* weighted,
                         std::uint32_t bones) noexcept {
    Float sum[axes] = {};
    for (std::uint32_t k = 0; k < bones; ++k) {
      const Float point = Simd::load(weighted + pair * k);
#pragma GCC unroll 3
      for (unsigned axis = 0; axis < axes; ++axis) {
        const Float product = point * Simd::load(maps + first[k] + pair * axis);
        sum[axis] = k == 0 ? product : sum[axis] + product;
      }
    }
    if constexpr (axes == 2)
      return sums_of(sum[0], sum[1]);
    else
      return sums_of(sum[0], sum[1], sum[2]);
  }

  template <class Position>
  static void store(Float positions, unsigned point, Position& to) noexcept {
    typedef float Four __attribute__((vector_size(16)));
    const auto all = static_cast<typename Float::register_type>(positions);
    const Four one = point == 0 ? __builtin_shufflevector(all, all, 0, 1, 2, 3)
                                : __builtin_shufflevector(all, all, Simd::width - 4, Simd::width - 3,
                                                          Simd::width - 2, Simd::width - 1);
    __builtin_memcpy(static_cast<void*>(&to), &one, sizeof to);
  }

  /// Writes the points of pairs begin .. end. `fixed`: how many bones, so that there is no loop over them, or 0. Returns NaN in some lane if
  /// a position is not finite.
  template <class Position, std::uint32_t fixed>
  static Float run(const BlendPairs& all, std::size_t begin, std::size_t end, std::size_t influence,
                   std::uint32_t bones, Position* to) noexcept {
    constexpr unsigned axes = sizeof(Position) == 2 * sizeof(float) ? 2 : 3;
    if (fixed != 0) bones = fixed;
    const float *const maps = all.maps, *weighted = all.weighted + pair * influence;
    const std::uint32_t* first = all.first + influence;
    Float not_finite(0.0f);
    for (std::size_t i = begin; i < end; ++i, first += bones, weighted += pair * bones) {
#pragma GCC unroll 2
      for (unsigned k = 0; k < 2; k += points) {
        const Float at = positions<axes>(maps, first, weighted + 4 * k, bones);
        not_finite = not_finite | (at - at);
#pragma GCC unroll 2
        for (unsigned point = 0; point < points; ++point) store(at, point, to[all.of[i].number[k + point]]);
      }
    }
    return not_finite;
  }

  template <class Position>
  static bool blend(const BlendPairs& all, Position* to) noexcept {
    constexpr decltype(&run<Position, 0>) of_few[] = {run<Position, 0>, run<Position, 1>, run<Position, 2>,
                                                      run<Position, 3>, run<Position, 4>};
    Float not_finite(0.0f);
    std::size_t influence = 0, begin = 0;
    for (std::size_t i = 0; i < all.run_count; ++i) {
      const auto [bones, end] = all.runs[i];
      const auto run_of = bones < sizeof of_few / sizeof *of_few ? of_few[bones] : of_few[0];
      not_finite = not_finite | run_of(all, begin, end, influence, bones, to);
      influence += (end - begin) * bones;
      begin = end;
    }
    return Simd::bits(xsimd::isnan(not_finite)) == 0;
  }

 public:
  static constexpr BlendLoops loops{blend<SpaceRow>, blend<Vec3>, blend<Vec2>};
};

}  // namespace bch::detail
