// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "kernel/clearance_arguments.hpp"
#include "kernel/disc_pairs.hpp"
#include "kernel/lanes.hpp"

namespace bch::kernel {

/// When two discs touch of which A's moves by t v, 0 <= t <= 1: in double, from the floats (x, y), r and v,
///
///     R = r + 2^-20 D,    D = |(x, y)|,    h = x v_y - y v_x,    b = x v_x + y v_y
///     t = (D^2 - R^2) / (b + sqrt(R^2 v^2 - h^2)),    T = float(t (1 - 2^-22))
///
/// or 0 where D <= R, and never where b <= 0 or the root is not real. It is asked only of discs that do not overlap.
///
/// Never too late, in the notation of layout/rounding.hpp. Where the tight discs touch at the true time t, the exact
/// way between their centres is r_tight long. (x, y) is off by 8.1 u P_B + 5.6 u |d| + u D; v is rotated as d is, so
/// t v is off by 4.6 u t |v|, and t |v| <= D + S; |d| <= D + S: 18.3 u S + 11.2 u D in all, and u S for r. Published
/// radii have 23 u S to spare, R adds 16 u D. So at t the float discs of radius R overlap, and their first contact
/// is not later. (Discs that do not move towards each other, b <= 0, where exact ones would: b is off by some u D
/// |v|, so those come nearer by the square of that, and overlap at the start.) The arithmetic in double is off by
/// 1e-15, the last product takes off 4 u for that and for the rounding to float.
///
/// Bounds. At T the centres of discs (C, R') that hold the two are within R'_A + R'_B + 16 u D, and 12 u D more at
/// the best time, if T is not above that: rounding brings 20 u S and 4 u D beside, and D <= D' + 2 S. A radius
/// enlarged by `slack` = 128 u S and 128 u (|x| + |y|) has room for the 84 u S and 32 u D', and for 20 u D' of what
/// is computed from it.
template <class Simd>
class ContactTimeMeasure {
 public:
  using Float = typename Simd::Float;

  /// v, and S in metres.
  ContactTimeMeasure(float x, float y, float reach) noexcept : x_(x), y_(y), slack_(0x1p-17f * reach) {
    const float square = x * x + y * y;
    // A way shorter than that is none, which the slack covers: bounds are then those of discs at rest.
    if (square < 1e-30f) return;
    per_square_ = 1 / square;
    per_length_ = (1 - 0x1p-20f) / __builtin_sqrtf(square);
  }

  float time() const noexcept { return time_; }
  float best() const noexcept { return time_ < 1 ? time_ : 1; }

  /// The time at which the discs' front and back would meet if both were as wide as the world; far_beyond where the
  /// discs stay apart until the best time.
  Float bound(Float x, Float y, Float r) const noexcept {
    const Float radius = enlarged(x, y, r);
    const Float time = ((x * Float(x_) + y * Float(y_)) * Float(per_length_) - radius) * Float(per_length_);
    return Simd::select(meet_by(x, y, radius, best()), xsimd::max(time, Float(0.0f)), Float(far_beyond));
  }

  void meet(const Transform& at, Discs a, Discs b, std::uint32_t, std::uint32_t) noexcept {
    std::uint64_t open = 0;
    visit_disc_pairs<Simd>(at, a, b, [&](unsigned k, Float x, Float y, Float r) {
      open |= std::uint64_t{Simd::bits(meet_by(x, y, enlarged(x, y, r), best()))} << k;
    });
    for (; open != 0; open &= open - 1) {
      const auto k = static_cast<unsigned>(__builtin_ctzll(open));
      const unsigned i = k / block_width, j = k % block_width;
      const float bx = b.x[j], by = b.x[b.stride + j];
      take(at.tx + (at.c * bx - at.s * by) - a.x[i], at.ty + (at.s * bx + at.c * by) - a.x[a.stride + i],
           a.x[2 * a.stride + i] + b.x[2 * b.stride + j]);
    }
  }

  /// Takes the time of two discs of the cuts.
  void take(float x, float y, float r) noexcept {
    const double dx = x, dy = y, vx = x_, vy = y_;
    const double square = dx * dx + dy * dy, towards = dx * vx + dy * vy;
    const double radius = static_cast<double>(r) + 0x1p-20 * __builtin_sqrt(square);
    const double aside = dx * vy - dy * vx;
    const double under_root = radius * radius * (vx * vx + vy * vy) - aside * aside;
    if (towards <= 0 || under_root < 0) return;
    const double left = square - radius * radius;
    const double time = left <= 0 ? 0 : left / (towards + __builtin_sqrt(under_root)) * (1 - 0x1p-22);
    if (time <= static_cast<double>(best())) time_ = static_cast<float>(time);
  }

 private:
  Float enlarged(Float x, Float y, Float r) const noexcept {
    return r + Float(slack_) + Float(0x1p-17f) * (xsimd::abs(x) + xsimd::abs(y));
  }

  /// Whether A's disc sweeps over B's in times up to t: by the place on its way that is nearest to B's.
  typename Simd::Mask meet_by(Float x, Float y, Float radius, float t) const noexcept {
    const Float towards = (x * Float(x_) + y * Float(y_)) * Float(per_square_);
    const Float nearest = xsimd::min(xsimd::max(towards, Float(0.0f)), Float(t));
    const Float left_x = x - nearest * Float(x_), left_y = y - nearest * Float(y_);
    return left_x * left_x + left_y * left_y <= radius * radius;
  }

  float x_ = 0, y_ = 0, slack_ = 0;
  float per_square_ = 0, per_length_ = 0;
  float time_ = __builtin_inff();
};

}  // namespace bch::kernel
