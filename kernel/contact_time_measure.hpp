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
/// |v|, so those come nearer by the square of that, and overlap at the start.) Double loses 2^-51 of
/// the squares that are subtracted, which may be much of what is left. But R exceeds what touches at t by 3.7 u S + 4.8 u D,
/// at least 2^-23 of itself, so that such a loss moves the contact by less than 2^-28 of what that does. The last product
/// takes off 4 u for the rounding to float.
///
/// Bounds are the times at which discs (C, R') that hold the two touch, enlarged. At T the centres are within R'_A +
/// R'_B + 16 u D, and rounding brings 20 u S and 4 u D beside, with D <= D' + 2 S: 60 u S + 20 u D'. The distances along
/// the way and aside are off by 5 u D' each. That and 3 u of the squares make the root smaller by less than a radius
/// enlarged by 10 u D' does, and the difference later by 5 u D' + u R', R' <= 2 S. For all that, 62 u S + 35 u D', `slack`
/// is 128 u F, with S <= F and D' <= F. Times are shortened by 16 u, for the 3 u of 1 / |v| and the product's; those below
/// 0, before every T, only have to stay there. The root is rough_root(), lengthened by more than that is off.
template <class Simd>
class ContactTimeMeasure {
 public:
  using Float = typename Simd::Float;

  /// v, and F in metres.
  ContactTimeMeasure(float x, float y, float farthest) noexcept : x_(x), y_(y), slack_(0x1p-17f * farthest) {
    const float square = x * x + y * y;
    // Of a way shorter than that all bounds are 0.
    if (square < 1e-30f) return;
    per_length_ = (1 - 0x1p-20f) / __builtin_sqrtf(square);
    unit_x_ = x * per_length_, unit_y_ = y * per_length_;
  }

  float time() const noexcept { return time_; }
  float best() const noexcept { return time_ < 1 ? time_ : 1; }

  /// When the discs touch first, below 0 where that is before the way begins; far_beyond where they do not.
  Float bound(Float x, Float y, Float r) const noexcept {
    const Float radius = r + Float(slack_);
    const Float along = x * Float(unit_x_) + y * Float(unit_y_);
    const Float aside = x * Float(unit_y_) - y * Float(unit_x_);
    const Float left = radius * radius - aside * aside, zero(0.0f), never(far_beyond);
    const Float half = rough_root<Simd>(left) * Float(1 + Simd::rough);
    const Float time = (along - half) * Float(per_length_);
    return Simd::select(left >= zero, Simd::select(along + half >= zero, time, never), never);
  }

  /// The pair with the least bound first, which leaves out most others.
  void meet(const Transform& at, Discs a, Discs b, std::uint32_t, std::uint32_t) noexcept {
    alignas(64) float bounds[block_pairs];
    visit_disc_pairs<Simd>(
        at, a, b, [&](unsigned k, Float x, Float y, Float r) { Simd::store(bounds + k, bound(x, y, r)); });
    const auto take_pair = [&](unsigned k) {
      const auto [x, y, r] = disc_pair<Simd>(at, a, b, k);
      take(x, y, r);
    };
    const float least = least_value<Simd>(bounds);
    if (!(least <= best())) return;
    const unsigned first = first_within<Simd>(bounds, least);
    take_pair(first);
    std::uint64_t open = all_within<Simd>(bounds, best()) & ~(std::uint64_t{1} << first);
    for (; open != 0; open &= open - 1) {
      const auto k = static_cast<unsigned>(__builtin_ctzll(open));
      if (bounds[k] <= best()) take_pair(k);
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
  float x_ = 0, y_ = 0, slack_ = 0;
  float per_length_ = 0, unit_x_ = 0, unit_y_ = 0;
  float time_ = __builtin_inff();
};

}  // namespace bch::kernel
