// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <type_traits>

#include "kernel/distance/clearance_arguments.hpp"
#include "kernel/simd/disc_pairs.hpp"
#include "layout/base/rounding.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Holds the errors of a time of impact and of its bounds, in units of u: the sums that TimeOfImpactMeasure
/// derives.
namespace time_of_impact_terms {

namespace r = rounding::terms;

constexpr double of_distance = 11.2, lengthening = 16;  // of D; R's
constexpr double overlap = 4;  // of r^2: collide()'s test rounds two squares, a sum and r^2
static_assert(overlap >= 2 * r::square + 1 + 0x1p-10 && overlap / 2 <= lengthening);
static_assert(r::length_within(r::arm + r::position + 2 * r::sum, r::position + 1, r::contact_error), "of B");
static_assert(r::length_within(r::position + r::sum, r::position + 1, r::contact_error), "of A");
static_assert(of_distance >= 2 * r::position + r::sum + r::apart - 0x1p-40);
static_assert(lengthening >= of_distance + 2);

/// The errors of bounds, in S and D': the discs at T, with D <= D' + 2 S; the lengths; the root of their
/// squares; the difference.
constexpr double at_contact_reach = 60, at_contact_distance = 20;
static_assert(at_contact_reach >= 20 + 2 * (lengthening + 4) && at_contact_distance >= lengthening + 4);
constexpr double root_reach = 19, root_distance = 7, difference_reach = 15, difference_distance = 8;
constexpr double bound_reach = 94, bound_distance = 35;
static_assert(bound_reach >= at_contact_reach + root_reach + difference_reach);
static_assert(bound_distance >= at_contact_distance + root_distance + difference_distance);
constexpr double displacement_error = 6;  // of S, where approximate_sqrt() is exact
constexpr double slack = 256;             // of F
static_assert(slack >= bound_reach + bound_distance + displacement_error);

}  // namespace time_of_impact_terms

/// Finds when two discs touch of which A's moves by t v, 0 <= t <= 1. It computes in double, from the floats
/// (x, y), r and v,
///
///     R = r + 2^-20 D,    D = |(x, y)|,    h = x v_y - y v_x,    b = x v_x + y v_y
///     t = (D^2 - R^2) / (b + sqrt(R^2 v^2 - h^2)),    T = float(t (1 - 2^-22))
///
/// or 0 where D <= R, and never where b <= 0 or the root is not real; but 0 wherever D^2 <= r^2 (1 + 4 u),
/// also of discs that move apart, because the outlines in them may yet meet. That holds wherever collide()'s
/// test in float accepts the two, as it rounds the squares by 3 u of them; D <= r in double would not, and
/// who collides needs the time 0 by its discs as well.
///
/// Never too late, in the notation of layout/base/rounding.hpp. Where the tight discs touch at the true time
/// t, the exact displacement between their centres is r_tight long. (x, y) is off by 8.1 u |b| + 5.6 u |d| + u D; v is
/// rotated as d is, so t v is off by 4.6 u t |v|, and t |v| <= D + r_A + r_B; |d| <= |a| + |b| + D; and r is
/// off by u (r_A + r_B). In all that is 13.7 u |b| + 5.6 u |a| + 5.6 u (r_A + r_B) + 11.2 u D, of which the
/// first three are at most 14.9 u S, as in (1'). Published radii have 16.5 u S to spare, R adds 16 u D. So at
/// t the float discs of radius R overlap, and their first contact is not later. (Discs that do not move
/// towards each other, b <= 0, where exact ones would: b is off by some u D |v|, so those come nearer by the
/// square of that, and overlap at the start.) Double loses 2^-51 of the squares that are subtracted, which
/// may be much of what is left. But R exceeds what touches at t by 4.8 u D, where D > r, at least 2^-23 of
/// itself, so that such a loss moves the contact by less than 2^-28 of what that does. The last product takes
/// off 4 u for the rounding to float.
///
/// Bounds are how far A has come when discs (C, R') that hold the two touch, enlarged. What is along the displacement
/// and aside is computed at once, from discs of both sides turned into the displacement's frame by (w_x, w_y), which
/// is v / |v| made shorter by `rough` of it: so are all lengths but the radii. At T the centres are within
/// R'_A + R'_B + 16 u D, also of discs that move apart, and rounding adds 20 u S and 4 u D, with D
/// <= D' + 2 S: 60 u S + 20 u D'. The turn adds 2 u of each coefficient of B's placement, of |d| and of A's
/// centre, and rounds two sums more: 6 u P_B + 2 u P_A + 3 u |d| + u D', where centres are within 1.42
/// reaches; with 2.5 u D' for (w_x, w_y) itself either length is off by 13 u S + 7 u D'. The squares' 3 u
/// make that 19 u S + 7 u D' of the root, the difference is later by 15 u S + 8 u D'. A radius enlarged by 94
/// u S + 35 u D' makes up for all, and `slack` is 256 u F, with S <= F and D' <= F: enough, too, for the
/// squares of discs that touch during the displacement to differ by far more than their rounding, so that a root of what
/// is not above 0, NaN, is that of discs that never touch. As radii are not made shorter, the root is longer
/// than its part of the displacement by more than approximate_sqrt() is off; where that is exact, (w_x, w_y) is off by as
/// much as 3 u R' <= 6 u S, for which slack has room. A time T is compared as T |v|, shorter as lengths are
/// and then a 2^18th longer, for what |v| and the products are off by. Bounds below 0 only have to stay
/// there.
///
/// A test sees the slack: without it, or with F of one shape alone, tests/kernel/queries_test.cpp finds
/// later times than brute force does.
template <class Simd>
class TimeOfImpactMeasure {
 public:
  using Float = typename Simd::Float;

  TimeOfImpactMeasure() = default;
  /// Takes v, and F in metres.
  TimeOfImpactMeasure(float x, float y, float farthest) noexcept
      : x_(x), y_(y), slack_(slack_per_length * farthest), time_(__builtin_inff()) {
    const float square = x * x + y * y, length = __builtin_sqrtf(square);
    // No bound of a displacement that is shorter than that is above 0.
    const float per_length = square < 1e-30f ? 0 : (1 - Simd::approximation_error) / length;
    unit_x_ = x * per_length, unit_y_ = y * per_length;
    length_ = length * ((1 - Simd::approximation_error) * (1 + 0x1p-18f));
  }

  float x() const noexcept { return x_; }
  float y() const noexcept { return y_; }
  float time() const noexcept { return time_; }

  /// Returns the limit of bounds: what is below a bound above it is later than the time so far, or than the
  /// end of the displacement.
  float limit() const noexcept { return best() * length_; }

  /// Calls visit(k, bound) for every register of pairs as visit_disc_pairs() does; far_beyond for those that
  /// never touch.
  template <class Visit>
  [[gnu::always_inline]] void visit_bounds(const Transform& at, Discs a, Discs b,
                                           Visit visit) const noexcept {
    constexpr unsigned stride = Simd::width < block_width ? block_width : Simd::width;
    alignas(64) float turned[3 * stride];
    const Float ux(unit_x_), uy(unit_y_), slack(slack_), zero(0.0f), never(far_beyond);
    for (unsigned k = 0; k < block_width; k += Simd::width) {
      const auto of_a = [&](const float* eight) {
        return Simd::template columns<block_width>(eight, k / Simd::width);
      };
      const Float x = of_a(a.x), y = of_a(a.y());
      Simd::store(turned + k, ux * x + uy * y);
      Simd::store(turned + stride + k, ux * y - uy * x);
      Simd::store(turned + 2 * stride + k, of_a(a.radius()) + slack);
    }
    const Transform moved{unit_x_ * at.c + unit_y_ * at.s, unit_x_ * at.s - unit_y_ * at.c,
                          unit_x_ * at.tx + unit_y_ * at.ty, unit_x_ * at.ty - unit_y_ * at.tx};
    visit_disc_pairs<Simd>(moved, Discs{turned, stride, 2 * stride}, b,
                           [=](unsigned k, Float along, Float aside, Float radius) {
                             const Float half = Simd::approximate_sqrt(radius * radius - aside * aside);
                             // Pairs whose root is NaN never touch.
                             visit(k, Simd::select(along + half >= zero, along - half, never));
                           });
  }

  /// Returns when two discs touch, infinity for never; lane by lane, or for a single pair.
  template <class Real>
  [[gnu::always_inline]] static Real time_of(Real x, Real y, Real r, Real vx, Real vy) noexcept {
    const Real zero(0.0), never(__builtin_inf());
    const Real square = x * x + y * y, towards = x * vx + y * vy;
    const Real radius = r + Real(lengthening) * xsimd::sqrt(square);
    const Real aside = x * vy - y * vx;
    const Real under_root = radius * radius * (vx * vx + vy * vy) - aside * aside;
    const Real left = square - radius * radius;
    const Real time = left / (towards + xsimd::sqrt(xsimd::max(under_root, zero))) * Real(1 - 0x1p-22);
    const auto select = [](const auto& which, const Real& yes, const Real& no) {
      if constexpr (std::is_same_v<Real, double>)
        return which ? yes : no;
      else
        return xsimd::select(which, yes, no);
    };
    const Real later =
        select((towards > zero) & (under_root >= zero), select(left > zero, time, zero), never);
    return select(square <= r * r * Real(1 + overlap), zero, later);
  }
  void update(double time) noexcept {
    if (time <= static_cast<double>(best())) time_ = static_cast<float>(time);
  }

 private:
  static constexpr float slack_per_length = 0x1p-16f;
  static constexpr double lengthening = 0x1p-20;
  static constexpr double overlap = 0x1p-22;
  static_assert(double{slack_per_length} >= time_of_impact_terms::slack * rounding::unit_roundoff);
  static_assert(lengthening >= time_of_impact_terms::lengthening * rounding::unit_roundoff);
  static_assert(overlap >= time_of_impact_terms::overlap * rounding::unit_roundoff);

  float best() const noexcept { return time_ < 1 ? time_ : 1; }

  float x_, y_, slack_;
  float unit_x_, unit_y_;
  float length_;  ///< of the displacement, in units of bounds
  float time_;
};

}  // namespace bch::detail
