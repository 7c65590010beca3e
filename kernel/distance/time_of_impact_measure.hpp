// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <type_traits>

#include "kernel/distance/clearance_arguments.hpp"
#include "kernel/simd/disc_pairs.hpp"
#include "layout/base/rounding.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Holds the errors of a time of impact and of its bounds, derived at TimeOfImpactMeasure, in units of u.
namespace time_of_impact_terms {

namespace r = rounding::terms;

constexpr double of_distance = 11.2, lengthening = 16;  // of D; R's
constexpr double overlap = 4;  // of r^2: collide()'s test rounds two squares, a sum and r^2
static_assert(overlap >= 2 * r::square + 1 + 0x1p-10 && overlap / 2 <= lengthening);
static_assert(r::length_within(r::arm + r::position + 2 * r::sum, r::position + 1, r::contact_error), "of B");
static_assert(r::length_within(r::position + r::sum, r::position + 1, r::contact_error), "of A");
static_assert(of_distance >= 2 * r::position + r::sum + r::apart - 0x1p-40);
static_assert(lengthening >= of_distance + 2);

/// The errors of bounds, in S and D', with D <= D' + 2 S: (6), (8), (9), (10).
constexpr double at_contact_extent = 60, at_contact_distance = 20;
static_assert(at_contact_extent >= 20 + 2 * (lengthening + 4) && at_contact_distance >= lengthening + 4);
constexpr double root_extent = 19, root_distance = 7, difference_extent = 15, difference_distance = 8;
constexpr double bound_extent = 94, bound_distance = 35;
static_assert(bound_extent >= at_contact_extent + root_extent + difference_extent);
static_assert(bound_distance >= at_contact_distance + root_distance + difference_distance);
constexpr double displacement_error = 6;  // of S, where approximate_sqrt() is exact
constexpr double slack = 256;             // of F
static_assert(slack >= bound_extent + bound_distance + displacement_error);

}  // namespace time_of_impact_terms

/// Finds the time at which two discs touch, if A's disc moves by t v, 0 <= t <= 1. In double, from the floats
/// (x, y), r and v:
///
///     R = r + 2^-20 D,    D = |(x, y)|,    h = x v_y - y v_x,    b = x v_x + y v_y
///     t = (D^2 - R^2) / (b + sqrt(R^2 v^2 - h^2)),    T = float(t (1 - 2^-22))
///     T = 0       if D <= R and b > 0, or if D^2 <= r^2 (1 + 4 u)
///     T = never   else, if b <= 0 or the root is not real
///
/// Discs with D^2 <= r^2 (1 + 4 u) have time 0 even if they move apart, because the outlines in them may
/// still touch later. That includes all discs which collide()'s test in float accepts, whose squares are
/// rounded by up to 3 u; so agents that collide have time 0 by their discs, too. (D <= r in double would miss
/// some.)
///
/// Never too late, with the notation of layout/base/rounding.hpp. At the true time t of the exact discs, the
/// exact distance of their centres is the sum of the tight radii. t |v| <= D + r_A + r_B, and |d| <= |a| + |b| +
/// D. The errors at time t:
///
///     (1) (x, y) is off by 8.1 u |b| + 5.6 u |d| + u D; t v, which is rotated as d is, by 4.6 u t |v|; r by
///         u (r_A + r_B)
///     (2) in total 13.7 u |b| + 5.6 u |a| + 5.6 u (r_A + r_B) + 11.2 u D. The first three terms are at most
///         14.9 u S, by the steps of (1') in rounding.hpp
///     (3) stored radii include 16.5 u S, and R adds 16 u D, which is more than (2)
///     (4) the subtraction of squares in double loses 2^-51 of them, possibly much of the difference. But R
///         exceeds the distance at t by 4.8 u D where D > r, which is at least 2^-23 of R. The loss changes
///         the time by less than 2^-28 of what this excess changes it
///     (5) the last product subtracts 4 u, for the rounding to float
///
/// So at time t the float discs of radius R overlap, and their first contact is not later. (The case of exact
/// discs that approach, but b <= 0 here: b is off by a few u D |v|. So these discs approach only by the square
/// of that error, and they overlap at the start.)
///
/// Bounds of nodes: how far A has moved when enlarged discs (C, R'), which contain the two discs, touch.
/// Distances along and across the displacement are computed at once, from the discs of both sides rotated by
/// (w_x, w_y) = v / |v| (1 - `rough`). So all lengths except radii are shortened. D' is the distance of the
/// centres C, D <= D' + 2 S, and F the length that the constructor gets.
///
///     (6) at T the centres are within R'_A + R'_B + 16 u D, also if discs move apart. Rounding adds 20 u S +
///         4 u D. In total 60 u S + 20 u D'
///     (7) the rotation adds 2 u of each coefficient of B's placement, of |d| and of A's centre, and rounds
///         two more sums: 6 u P_B + 2 u P_A + 3 u |d| + u D', with centres within 1.42 extents. (w_x, w_y)
///         adds 2.5 u D'. So either length, along or across, is off by at most 13 u S + 7 u D'
///     (8) with 3 u of the squares, the root is off by 19 u S + 7 u D'
///     (9) the difference is too late by at most 15 u S + 8 u D'
///    (10) the sum of (6), (8) and (9) is 94 u S + 35 u D'. Radii are enlarged by `slack` = 256 u F, which is
///         more, because S <= F and D' <= F
///    (11) the slack also makes the squares of discs that touch during the displacement differ by far more
///         than their rounding. So a negative square, whose root is NaN, belongs to discs that never touch
///    (12) radii are not shortened, so the root exceeds its part of the displacement by more than the error
///         of approximate_sqrt(). If approximate_sqrt() is exact, (w_x, w_y) is off by up to 3 u R' <= 6 u S,
///         which the slack covers
///    (13) a time T is compared as T |v|. This product is shortened as lengths are, and then lengthened by
///         2^-18 of itself, for the errors of |v| and of the products. Bounds below 0 only have to stay
///         below 0
///
/// Without the slack, or with F of one shape alone, tests/kernel/queries_test.cpp finds later times than
/// brute force does.
template <class Simd>
class TimeOfImpactMeasure {
 public:
  using Float = typename Simd::Float;

  TimeOfImpactMeasure() = default;
  /// (x, y) is v; `farthest` is F, metres.
  TimeOfImpactMeasure(float x, float y, float farthest) noexcept
      : x_(x), y_(y), slack_(slack_per_length * farthest), time_(__builtin_inff()) {
    const float square = x * x + y * y, length = __builtin_sqrtf(square);
    // The bounds of shorter displacements are never above 0.
    const float per_length = square < 1e-30f ? 0 : (1 - Simd::approximation_error) / length;
    unit_x_ = x * per_length, unit_y_ = y * per_length;
    length_ = length * ((1 - Simd::approximation_error) * (1 + 0x1p-18f));
  }

  float x() const noexcept { return x_; }
  float y() const noexcept { return y_; }
  float time() const noexcept { return time_; }

  /// Returns the largest useful bound: discs below nodes with a larger bound touch later than the time found
  /// so far, or after the end of the displacement.
  float limit() const noexcept { return best() * length_; }

  /// Calls visit(k, bounds) for one pair per lane, in the order of visit_disc_pairs(); far_beyond for pairs
  /// that never touch.
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

  /// Returns the time at which two discs touch, or infinity; lane by lane, or for a single pair.
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
