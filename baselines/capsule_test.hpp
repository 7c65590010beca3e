// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "baselines/capsule_lanes.hpp"

// The test of two ragdolls, for one instruction set a source that includes this. Unlike all else here it is fast, eight capsules side by
// side in the compiler's own vectors, since a contender is only worth a comparison at its best: boxes about capsules first, then the
// distances of the segments whose boxes overlap.

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"  // functions that take vectors are inlined
#endif

namespace bch::baselines {
namespace {

using Lanes = float __attribute__((vector_size(capsule_lanes * sizeof(float))));
using Mask = std::int32_t __attribute__((vector_size(capsule_lanes * sizeof(float))));

[[gnu::always_inline]] inline Lanes load(const float* from) {
  Lanes lanes;
  __builtin_memcpy(&lanes, from, sizeof(lanes));
  return lanes;
}
[[gnu::always_inline]] inline void store(float* to, const Lanes& lanes) {
  __builtin_memcpy(to, &lanes, sizeof(lanes));
}
[[gnu::always_inline]] inline Lanes smaller(const Lanes& a, const Lanes& b) {
  return a < b ? a : b;
}
[[gnu::always_inline]] inline Lanes larger(const Lanes& a, const Lanes& b) {
  return a > b ? a : b;
}
[[gnu::always_inline]] inline Lanes share(const Lanes& lanes) {
  return smaller(larger(lanes, Lanes{}), Lanes{} + 1.0f);
}

/// Returns a bit for each lane.
[[gnu::always_inline]] inline std::uint32_t bits(const Mask& mask) {
#ifdef __AVX__
  return static_cast<std::uint32_t>(__builtin_ia32_movmskps256(reinterpret_cast<Lanes>(mask)));
#else
  std::uint32_t all = 0;
  for (std::uint32_t k = 0; k < capsule_lanes; ++k) all |= (mask[k] != 0 ? 1u : 0u) << k;
  return all;
#endif
}

/// Holds the second ragdoll in the first one's frame.
struct Placed {
  alignas(sizeof(Lanes)) float fields[Field::count][most_capsules];
};

[[gnu::always_inline]] inline void place(const CapsulePair& pair, std::uint32_t stride, Placed& placed) {
  const auto turn = [&](std::uint32_t first, std::uint32_t at, float x0, float y0, float z0, Lanes* to) {
    const Lanes x = load(pair.b + first * stride + at), y = load(pair.b + (first + 1) * stride + at),
                z = load(pair.b + (first + 2) * stride + at);
    to[0] = x0 + (pair.cosine * x - pair.sine * y);
    to[1] = y0 + (pair.sine * x + pair.cosine * y);
    to[2] = z0 + z;
  };
  for (std::uint32_t at = 0; at < stride; at += capsule_lanes) {
    Lanes end[3], along[3];
    turn(Field::end_x, at, pair.x, pair.y, pair.z, end);
    turn(Field::along_x, at, 0, 0, 0, along);
    const Lanes r = load(pair.b + Field::radius * stride + at);
    store(&placed.fields[Field::radius][at], r);
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      store(&placed.fields[Field::end_x + axis][at], end[axis]);
      store(&placed.fields[Field::along_x + axis][at], along[axis]);
      store(&placed.fields[Field::low_x + axis][at], end[axis] + smaller(along[axis], Lanes{}) - r);
      store(&placed.fields[Field::high_x + axis][at], end[axis] + larger(along[axis], Lanes{}) + r);
    }
  }
}

/// Returns whether capsules overlap, one pair a lane. Source: C. Ericson, "Real-time collision detection", 2005, section 5.1.9; both
/// clamps without a branch. Capsules of no length are spheres.
[[gnu::always_inline]] inline std::uint32_t overlaps(const float (*a)[capsule_lanes],
                                                     const float (*b)[capsule_lanes]) {
  constexpr float tiny = 1e-12f;  // square metres
  const Lanes ux = load(a[Field::along_x]), uy = load(a[Field::along_y]), uz = load(a[Field::along_z]);
  const Lanes vx = load(b[Field::along_x]), vy = load(b[Field::along_y]), vz = load(b[Field::along_z]);
  const Lanes wx = load(a[Field::end_x]) - load(b[Field::end_x]),
              wy = load(a[Field::end_y]) - load(b[Field::end_y]),
              wz = load(a[Field::end_z]) - load(b[Field::end_z]);
  const Lanes uu = ux * ux + uy * uy + uz * uz + tiny, vv = vx * vx + vy * vy + vz * vz + tiny;
  const Lanes uv = ux * vx + uy * vy + uz * vz, uw = ux * wx + uy * wy + uz * wz,
              vw = vx * wx + vy * wy + vz * wz;
  const Lanes first = share((uv * vw - uw * vv) / (larger(uu * vv - uv * uv, Lanes{}) + tiny));
  const Lanes t = share((uv * first + vw) / vv);
  const Lanes s = share((uv * t - uw) / uu);
  const Lanes dx = wx + s * ux - t * vx, dy = wy + s * uy - t * vy, dz = wz + s * uz - t * vz;
  const Lanes r = load(a[Field::radius]) + load(b[Field::radius]);
  return bits(dx * dx + dy * dy + dz * dz <= r * r);
}

/// Collects pairs of capsules whose boxes overlap, and tests them eight at a time.
class Candidates {
 public:
  Candidates(const float* a, std::uint32_t stride, const Placed& b) : a_(a), stride_(stride), b_(b) {}

  /// Returns whether the capsules of a full batch overlap.
  [[gnu::always_inline]] bool add(std::uint32_t i, std::uint32_t j) {
    for (std::uint32_t field = 0; field <= Field::radius; ++field) {
      of_a_[field][count_] = a_[field * stride_ + i];
      of_b_[field][count_] = b_.fields[field][j];
    }
    if (++count_ < capsule_lanes) return false;
    count_ = 0;
    return overlaps(of_a_, of_b_) != 0;
  }
  [[gnu::always_inline]] bool rest() const {
    return count_ > 0 && (overlaps(of_a_, of_b_) & ((1u << count_) - 1)) != 0;
  }

 private:
  const float* a_;
  std::uint32_t stride_;
  const Placed& b_;
  std::uint32_t count_ = 0;
  alignas(sizeof(Lanes)) float of_a_[Field::radius + 1][capsule_lanes] = {},
                                                     of_b_[Field::radius + 1][capsule_lanes] = {};
};

[[gnu::always_inline]] inline std::uint32_t lane_count(std::uint32_t capsules) {
  return (capsules + capsule_lanes - 1) / capsule_lanes * capsule_lanes;
}

[[gnu::always_inline]] inline bool meet(const CapsulePair& pair) {
  const std::uint32_t stride_a = lane_count(pair.count_a), stride_b = lane_count(pair.count_b);
  Placed b;
  place(pair, stride_b, b);
  Candidates candidates(pair.a, stride_a, b);
  for (std::uint32_t i = 0; i < pair.count_a; ++i)
    for (std::uint32_t at = 0; at < stride_b; at += capsule_lanes) {
      const auto of_a = [&](std::uint32_t field) { return Lanes{} + pair.a[field * stride_a + i]; };
      const auto of_b = [&](std::uint32_t field) { return load(&b.fields[field][at]); };
      const Mask near =
          (of_a(Field::low_x) <= of_b(Field::high_x)) & (of_b(Field::low_x) <= of_a(Field::high_x)) &
          (of_a(Field::low_y) <= of_b(Field::high_y)) & (of_b(Field::low_y) <= of_a(Field::high_y)) &
          (of_a(Field::low_z) <= of_b(Field::high_z)) & (of_b(Field::low_z) <= of_a(Field::high_z));
      for (std::uint32_t left = bits(near); left != 0; left &= left - 1)
        if (candidates.add(i, at + static_cast<std::uint32_t>(__builtin_ctz(left)))) return true;
    }
  return candidates.rest();
}

inline void collide_all(const CapsulePair* pairs, std::size_t count, std::uint8_t* hits) {
  for (std::size_t i = 0; i < count; ++i) hits[i] = meet(pairs[i]) ? 1 : 0;
}

}  // namespace
}  // namespace bch::baselines
