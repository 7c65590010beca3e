// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "kernel/simd/transform.hpp"

namespace bch::detail {

/// Maps from B's frame into A's in space: a turn about the vertical, then a translation.
template <class Float>
struct SpaceTransformOf {
  TransformOf<Float> ground;
  Float tz;
};

/// Holds spheres side by side, one a lane.
template <class Float>
struct SpheresOf {
  Float x, y, z, radius;
};

/// Returns where a sphere of B is in A's frame. Every answer rests on the order of these operations, and of those of spheres_meet(); see
/// layout/body/sphere_rounding.hpp. (Inlined for certain, so that instruction sets share no function.)
template <class Float>
[[gnu::always_inline]] inline SpheresOf<Float> placed(const SpaceTransformOf<Float>& b_in_a,
                                                      const SpheresOf<Float>& b) noexcept {
  const auto [x, y] = b_in_a.ground.apply(b.x, b.y);
  return {x, y, b_in_a.tz + b.z, b.radius};
}

/// Returns the square of the distance of the centres of spheres in one frame.
template <class Float>
[[gnu::always_inline]] inline Float square_between(const SpheresOf<Float>& a,
                                                   const SpheresOf<Float>& b) noexcept {
  const Float x = b.x - a.x, y = b.y - a.y, z = b.z - a.z;
  return (x * x + y * y) + z * z;
}

/// Returns whether spheres in one frame are apart by at most a gap, which is included: a bool or a mask.
template <class Float>
[[gnu::always_inline]] inline auto spheres_meet(const SpheresOf<Float>& a, const SpheresOf<Float>& b,
                                                Float gap) noexcept {
  const Float radii = (a.radius + gap) + b.radius;
  return square_between(a, b) <= radii * radii;
}

}  // namespace bch::detail
