// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "layout/body/posing/posing_loops.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Implements the loops of SpherePoser. Nothing is added up across lanes, so that every instruction set gives the same bits.
template <class Simd>
class PosingLanes {
  using Float = typename Simd::Float;

  static void measure(const SphereCorners& all, const SphereFields& to) noexcept {
    std::uint32_t corner = 0;
    for (std::uint32_t s = 0; s < all.spheres; ++s) {
      const float* const centre = all.centres + std::size_t{4} * s;
      const Float x(centre[0]), y(centre[1]), z(centre[2]);
      Float farthest(0.0f);
      for (const std::uint32_t end = all.end[s]; corner < end; corner += Simd::width) {
        Float at[4];
        Simd::template load_records<4>(all.points, all.corners + corner, at);
        const Float dx = at[0] - x, dy = at[1] - y, dz = at[2] - z;
        farthest = Simd::max(dx * dx + dy * dy + dz * dz, farthest);
      }
      to.x[s] = centre[0], to.y[s] = centre[1], to.z[s] = centre[2];
      to.radius[s] = -Simd::least(-farthest);
    }
  }

  static float take_roots(const SphereFields& of, std::uint32_t count, const float* least,
                          float scale) noexcept {
    const Float enlarged(scale);
    Float max_extent(0.0f);
    for (std::uint32_t s = 0; s < count; s += Simd::width) {
      const Float x = Simd::load(of.x + s), y = Simd::load(of.y + s), z = Simd::load(of.z + s);
      Float radius = Simd::max(xsimd::sqrt(Simd::load(of.radius + s)), Simd::load(least + s));
      radius = radius + enlarged * radius;
      Simd::store(of.radius + s, radius);
      max_extent = Simd::max(xsimd::sqrt(x * x + y * y + z * z) + radius, max_extent);
    }
    return -Simd::least(-max_extent);
  }

 public:
  static constexpr PosingLoops loops{measure, take_roots};
};

}  // namespace bch::detail
