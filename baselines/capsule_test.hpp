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
[[gnu::always_inline]] inline Lanes clamp_to_unit(const Lanes& lanes) {
  return smaller(larger(lanes, Lanes{}), Lanes{} + 1.0f);
}

/// Returns a bit for each lane.
[[gnu::always_inline]] inline std::uint32_t bits(const Mask& mask) {
  constexpr Mask bit_of_lane = {1, 2, 4, 8, 16, 32, 64, 128};
  std::uint64_t halves[capsule_lanes / 2];
  const Mask chosen = mask & bit_of_lane;
  __builtin_memcpy(halves, &chosen, sizeof(halves));
  const std::uint64_t all = halves[0] | halves[1] | halves[2] | halves[3];
  return static_cast<std::uint32_t>(all | all >> 32) & 0xff;
}

/// Holds a box that moves along: the whole ragdoll's, or one capsule's.
struct Box {
  float low[3], high[3];
};

/// Returns the mask of the capsules of some lanes whose boxes overlap a box. `low_x`: the first of the six fields of boxes.
[[gnu::always_inline]] inline std::uint32_t near(const Box& box, const float* low_x, std::uint32_t stride) {
  const auto field = [&](std::uint32_t i) { return load(low_x + i * stride); };
  return bits((field(0) <= Lanes{} + box.high[0]) & (field(1) <= Lanes{} + box.high[1]) &
              (field(2) <= Lanes{} + box.high[2]) & (field(3) >= Lanes{} + box.low[0]) &
              (field(4) >= Lanes{} + box.low[1]) & (field(5) >= Lanes{} + box.low[2]));
}

/// Holds the second ragdoll in the first one's frame.
struct Placed {
  alignas(sizeof(Lanes)) float fields[Field::count][max_capsules];
  Box box;
};

[[gnu::always_inline]] inline void place(const CapsulePair& pair, std::uint32_t stride, Placed& placed) {
  const float* const of_b = pair.b + whole_box;
  const auto turn = [&](std::uint32_t first, std::uint32_t at, float x0, float y0, float z0, Lanes* to) {
    const Lanes x = load(of_b + first * stride + at), y = load(of_b + (first + 1) * stride + at),
                z = load(of_b + (first + 2) * stride + at);
    to[0] = x0 + (pair.cosine * x - pair.sine * y);
    to[1] = y0 + (pair.sine * x + pair.cosine * y);
    to[2] = z0 + z;
  };
  Lanes lows[3], highs[3];
  for (std::uint32_t at = 0; at < stride; at += capsule_lanes) {
    Lanes end[3], along[3];
    turn(Field::end_x, at, pair.x, pair.y, pair.z, end);
    turn(Field::along_x, at, 0, 0, 0, along);
    const Lanes r = load(of_b + Field::radius * stride + at);
    store(&placed.fields[Field::radius][at], r);
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const Lanes low = end[axis] + smaller(along[axis], Lanes{}) - r,
                  high = end[axis] + larger(along[axis], Lanes{}) + r;
      store(&placed.fields[Field::end_x + axis][at], end[axis]);
      store(&placed.fields[Field::along_x + axis][at], along[axis]);
      store(&placed.fields[Field::low_x + axis][at], low);
      store(&placed.fields[Field::high_x + axis][at], high);
      lows[axis] = at == 0 ? low : smaller(lows[axis], low);
      highs[axis] = at == 0 ? high : larger(highs[axis], high);
    }
  }
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    placed.box.low[axis] = lows[axis][0], placed.box.high[axis] = highs[axis][0];
    for (std::uint32_t k = 1; k < capsule_lanes; ++k) {
      placed.box.low[axis] = lows[axis][k] < placed.box.low[axis] ? lows[axis][k] : placed.box.low[axis];
      placed.box.high[axis] = highs[axis][k] > placed.box.high[axis] ? highs[axis][k] : placed.box.high[axis];
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
  const Lanes first = clamp_to_unit((uv * vw - uw * vv) / (larger(uu * vv - uv * uv, Lanes{}) + tiny));
  const Lanes t = clamp_to_unit((uv * first + vw) / vv);
  const Lanes s = clamp_to_unit((uv * t - uw) / uu);
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
  /// Returns whether those of the last batch do, whose other lanes repeat the first one.
  [[gnu::always_inline]] bool rest() {
    if (count_ == 0) return false;
    for (std::uint32_t field = 0; field <= Field::radius; ++field)
      for (std::uint32_t k = count_; k < capsule_lanes; ++k)
        of_a_[field][k] = of_a_[field][0], of_b_[field][k] = of_b_[field][0];
    return overlaps(of_a_, of_b_) != 0;
  }

 private:
  const float* a_;
  std::uint32_t stride_;
  const Placed& b_;
  std::uint32_t count_ = 0;
  alignas(sizeof(Lanes)) float of_a_[Field::radius + 1][capsule_lanes],
      of_b_[Field::radius + 1][capsule_lanes];
};

[[gnu::always_inline]] inline std::uint32_t lane_count(std::uint32_t capsules) {
  return (capsules + capsule_lanes - 1) / capsule_lanes * capsule_lanes;
}

/// Returns the mask of capsules whose boxes overlap a box.
[[gnu::always_inline]] inline std::uint32_t all_near(const Box& box, const float* low_x, std::uint32_t stride,
                                                     std::uint32_t capsules) {
  std::uint32_t mask = 0;
  for (std::uint32_t at = 0; at < lane_count(capsules); at += capsule_lanes)
    mask |= near(box, low_x + at, stride) << at;
  return mask & (~0u >> (max_capsules - capsules));
}

[[gnu::always_inline]] inline bool meet(const CapsulePair& pair) {
  const std::uint32_t stride_a = lane_count(pair.count_a);
  const float* const of_a = pair.a + whole_box;
  Placed b;
  place(pair, lane_count(pair.count_b), b);
  const float* const boxes_b = b.fields[Field::low_x];
  const std::uint32_t candidates_b =
      all_near({{pair.a[0], pair.a[1], pair.a[2]}, {pair.a[3], pair.a[4], pair.a[5]}}, boxes_b, max_capsules,
               pair.count_b);
  if (candidates_b == 0) return false;
  Candidates candidates(of_a, stride_a, b);
  for (std::uint32_t rows = all_near(b.box, of_a + Field::low_x * stride_a, stride_a, pair.count_a);
       rows != 0; rows &= rows - 1) {
    const auto i = static_cast<std::uint32_t>(__builtin_ctz(rows));
    const auto at = [&](std::uint32_t field) { return of_a[field * stride_a + i]; };
    const Box box{{at(Field::low_x), at(Field::low_y), at(Field::low_z)},
                  {at(Field::high_x), at(Field::high_y), at(Field::high_z)}};
    for (std::uint32_t left = all_near(box, boxes_b, max_capsules, pair.count_b) & candidates_b; left != 0;
         left &= left - 1)
      if (candidates.add(i, static_cast<std::uint32_t>(__builtin_ctz(left)))) return true;
  }
  return candidates.rest();
}

inline void collide_all(const CapsulePair* pairs, std::size_t count, std::uint8_t* hits) {
  for (std::size_t i = 0; i < count; ++i) hits[i] = meet(pairs[i]) ? 1 : 0;
}

}  // namespace
}  // namespace bch::baselines
