// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "kernel/body/body_clearance_arguments.hpp"
#include "kernel/body/clipped_leaves.hpp"
#include "kernel/body/placed_bodies.hpp"
#include "kernel/body/sphere_pairs.hpp"
#include "layout/body/sphere_rounding.hpp"

namespace bch::detail {

/// Finds the nearest spheres of two bodies: bounds the distance by that of the core spheres, measures the leaves whose nodes are nearest, and
/// then all others whose nodes may hold what is as near. A gap is 0 or less exactly where the test of a hit accepts two spheres;
/// layout/body/sphere_rounding.hpp has the formula, and why nothing is left out.
template <class Simd>
class NearestLeaves {
 public:
  /// Takes two bodies, whose gap is the limit, and the numbers of their spheres. `stop_below`: see BodyClearanceArguments.
  void begin(const PlacedBodies& bodies, const BodySetView& set, std::uint32_t body_a, std::uint32_t body_b,
             float stop_below) noexcept {
    bodies_ = bodies, set_ = &set, body_a_ = body_a, body_b_ = body_b, stop_below_ = stop_below;
    nearest_ = {bodies.gap, no_slot, no_slot};
  }

  /// Bounds the distance by the core spheres. Returns whether that is enough.
  bool bound_by_cores() noexcept {
    for (unsigned i = 0; i < core_spheres; i += 8)
      for (unsigned j = 0; j < core_spheres; j += 8)
        if (bound_by(core_of(bodies_.a, i), core_of(bodies_.b, j)) && stop_below_ >= 0) return true;
    return false;
  }

  /// Returns the bodies; their gap is a bound of the distance, and the least so far.
  const PlacedBodies& bodies() const noexcept { return bodies_; }

  /// Searches the leaves that reach the other body.
  NearestSpheres search(const Reach& reach_a, const Reach& reach_b) noexcept {
    if (!leaves_.list(bodies_, &reach_a, &reach_b, 1) || !clip_by_extents(reach_a, reach_b)) return nearest_;
    leaves_.place_columns(bodies_);
    for (std::uint32_t row = 0; row < leaves_.rows && !is_done();) row = measure_rows(row);
    return nearest_;
  }

 private:
  using Float = typename Simd::Float;
  using Mask = typename Simd::Mask;

  bool is_done() const noexcept { return bodies_.gap <= stop_below_; }

  /// Bounds the distance by that of 8 x 8 spheres, which need not be exact. Returns whether some overlap.
  [[gnu::noinline]] bool bound_by(Balls a, Balls b) noexcept {
    constexpr float longer =
        (1 + 2 * Simd::approximation_error) * (1 + 0x1p-20f);  // than the root, and far_centres
    Float least(bodies_.gap);
    Mask overlap = Float(1.0f) < Float(0.0f);
    visit_ball_pairs<Simd, 8>(
        bodies_.b_in_a, a, b, [&](unsigned, const SpheresOf<Float>& of_a, const SpheresOf<Float>& of_b) {
          const Float square = square_between(of_a, of_b), radii = of_a.radius + of_b.radius;
          overlap = overlap | (square <= radii * radii);
          least = xsimd::min(least, approximate_sqrt<Simd>(square) * Float(longer) - radii);
        });
    bodies_.gap = Simd::least(least);
    return Simd::bits(overlap) != 0;
  }
  using Leaves = ClippedLeaves<Simd>;

  /// Measures leaves of rows from `begin` on whose nodes are sufficiently near, first those whose nodes are nearest, so that the distance soon is
  /// nearly what it will be. Returns the end of these rows.
  std::uint32_t measure_rows(std::uint32_t begin) noexcept {
    const auto shift =
        static_cast<std::uint32_t>(32 - __builtin_clz((leaves_.columns - 1) | (Simd::width - 1) | 1));
    const std::uint32_t rows = std::uint32_t{max_bounds} >> shift, left = leaves_.rows - begin;
    const std::uint32_t end = begin + (left < rows ? left : rows);
    float least = 0;
    const std::uint32_t size = list_near(begin, end, shift, least);
    if (size == 0) return end;
    std::uint32_t nearest = 0;
    while (bound_[near_[nearest]] > least) ++nearest;
    const auto measure_one = [&](std::uint32_t i) {
      const std::uint32_t at = near_[i];
      measure(leaves_.leaf_a[begin + (at >> shift)], leaves_.leaf_b[at & ((1u << shift) - 1)]);
    };
    measure_one(nearest);
    for (std::uint32_t i = 0; i < size && !is_done(); ++i)
      if (i != nearest && bound_[near_[i]] <= bodies_.margin()) measure_one(i);
    return end;
  }

  /// Finds how far leaves reach towards the other body, along the axis on which both are apart most, and drops those that do not reach
  /// it: spheres bound the distance there better than their nodes do. Returns whether both have some. (Their errors are fewer than
  /// those of a node and a support, which the margin has room for.)
  bool clip_by_extents(const Reach& reach_a, const Reach& reach_b) noexcept {
    constexpr unsigned axis = Reach::axes / 2;
    const float x = -reach_a.x[axis], y = -reach_a.y[axis];
    origins_apart_ = bodies_.b_in_a.ground.tx * x + bodies_.b_in_a.ground.ty * y;
    const float max_a = find_extents(bodies_.a, leaves_.leaf_a, leaves_.rows, x, y, extent_a_);
    const float max_b = find_extents(bodies_.b, leaves_.leaf_b, leaves_.columns, -reach_b.x[axis],
                                     -reach_b.y[axis], extent_b_);
    const float least = origins_apart_ - bodies_.margin();
    leaves_.rows = drop(leaves_.leaf_a, extent_a_, leaves_.rows, least - max_b);
    leaves_.columns = drop(leaves_.leaf_b, extent_b_, leaves_.columns, least - max_a);
    for (std::uint32_t i = leaves_.columns; i < leaves_.columns + Simd::width; ++i) extent_b_[i] = 0;
    return leaves_.rows != 0 && leaves_.columns != 0;
  }
  /// Returns the largest one.
  static float find_extents(const float* record, const std::uint16_t* leaf, std::uint32_t size, float x,
                            float y, float* extents) noexcept {
    float most = -__builtin_inff();
    for (std::uint32_t i = 0; i < size; ++i) {
      extents[i] = extent(balls_of(record, leaf[i]), x, y);
      most = extents[i] < most ? most : extents[i];
    }
    return most;
  }
  /// Drops leaves with less than that. Returns how many are left.
  static std::uint32_t drop(std::uint16_t* leaf, float* extents, std::uint32_t size, float least) noexcept {
    std::uint32_t left = 0;
    for (std::uint32_t i = 0; i < size; ++i) {
      leaf[left] = leaf[i], extents[left] = extents[i];
      left += extents[i] >= least;
    }
    return left;
  }
  static float extent(const Balls& of, float x, float y) noexcept {
    return of.stride == 8 ? extent<8>(of, x, y) : extent<4>(of, x, y);
  }
  template <unsigned count>
  [[gnu::always_inline]] static float extent(const Balls& of, float x, float y) noexcept {
    constexpr unsigned parts = Simd::width < count ? count / Simd::width : 1;
    Float least(__builtin_inff());
#pragma GCC unroll 8
    for (unsigned part = 0; part < parts; ++part)
      least = xsimd::min(least, (Float(-x) * Simd::template columns<count>(of.field(0), part) +
                                 Float(-y) * Simd::template columns<count>(of.field(1), part)) -
                                    Simd::template columns<count>(of.field(3), part));
    return -Simd::least(least);
  }

  /// Bounds how far nodes are apart, and lists those that are sufficiently near; `least` is the least of their bounds. Returns how many.
  std::uint32_t list_near(std::uint32_t begin, std::uint32_t end, std::uint32_t shift,
                          float& least) noexcept {
    const Float most(bodies_.margin());
    Float nearest(__builtin_inff());
    std::uint32_t size = 0;
    for (std::uint32_t row = begin; row < end; ++row) {
      const auto node = leaves_.node(bodies_.a, leaves_.leaf_a[row]);
      const std::uint32_t first = (row - begin) << shift;
      const Float begin_of_b(origins_apart_ - extent_a_[row]);
      for (std::uint32_t k = 0; k < leaves_.columns; k += Simd::width) {
        const Float dx = Simd::load(leaves_.x + k) - node.x, dy = Simd::load(leaves_.y + k) - node.y;
        const Float across = rough_length(dx * dx + dy * dy) - (Simd::load(leaves_.radius + k) + node.radius);
        const Float up =
            xsimd::max(node.bottom - Simd::load(leaves_.top + k), Simd::load(leaves_.bottom + k) - node.top);
        const Float less = xsimd::min(across, up), more = xsimd::max(across, up);
        const Float bound =
            xsimd::max(begin_of_b - Simd::load(extent_b_ + k),
                       Simd::select(less > Float(0.0f), rough_length(less * less + more * more), more));
        Simd::store(bound_ + first + k, bound);
        // Nodes behind the last one are infinitely far away, or NaN.
        const Mask near = (across <= most) & (bound <= most);
        nearest = xsimd::min(nearest, Simd::select(near, bound, nearest));
        size += Simd::compress_indices(Simd::bits(near), first + k, near_ + size);
      }
    }
    least = Simd::least(nearest);
    return size;
  }

  /// Returns the root of a square, or a little less.
  static Float rough_length(Float square) noexcept {
    return approximate_sqrt<Simd>(square) * Float(1 - Simd::approximation_error);
  }

  void measure(std::uint32_t leaf_a, std::uint32_t leaf_b) noexcept {
    const Balls a = balls_of(bodies_.a, leaf_a), b = balls_of(bodies_.b, leaf_b);
    visit_blocks(a, b, [&]<unsigned count>(unsigned i, unsigned j) {
      const float least = least_gap<count>(a.from(i), b.from(j));
      if (!(least <= bodies_.gap)) return false;
      bodies_.gap = least;
      const auto slot = [](const Balls& of, std::uint32_t leaf, unsigned in_leaf) {
        return leaf * static_cast<std::uint32_t>(of.stride) + in_leaf;
      };
      for (unsigned first = 0; first < count * count; first += Simd::width)
        for (std::uint32_t left = Simd::bits(Simd::load(gaps_ + first) <= Float(least)); left != 0;
             left &= left - 1) {
          const unsigned k = first + static_cast<unsigned>(__builtin_ctz(left));
          offer({least, slot(a, leaf_a, i + k / count), slot(b, leaf_b, j + k % count)});
        }
      return false;
    });
  }

  /// Returns the least gap of two blocks of spheres, and keeps all; or infinity if there surely is none up to the bodies' gap.
  template <unsigned count>
  [[gnu::noinline]] float least_gap(Balls a, Balls b) noexcept {
    if (!balls_meet<Simd, count>(bodies_.b_in_a, a, b, bodies_.margin())) return __builtin_inff();
    Float least(__builtin_inff());
    visit_ball_pairs<Simd, count>(
        bodies_.b_in_a, a, b,
        [&least, to = gaps_](unsigned k, const SpheresOf<Float>& of_a, const SpheresOf<Float>& of_b) {
          const Float gap = NearestLeaves::gap(of_a, of_b);
          Simd::store(to + k, gap);
          least = xsimd::min(least, gap);
        });
    return Simd::least(least);
  }

  [[gnu::always_inline]] static Float gap(const SpheresOf<Float>& a, const SpheresOf<Float>& b) noexcept {
    const Float square = square_between(a, b), radii = a.radius + b.radius;
    const Float apart = xsimd::sqrt(square) * Float(rounding::far_centres) - radii;
    return Simd::select(square <= radii * radii, xsimd::min(apart, Float(0.0f)),
                        apart * Float(rounding::near_gap));
  }

  /// Takes spheres that are as near as any so far, unless equally near ones have lower numbers.
  void offer(const NearestSpheres& other) noexcept {
    if (nearest_.a != no_slot && other.distance == nearest_.distance) {
      const std::uint32_t a = set_->number(body_a_, other.a), least_a = set_->number(body_a_, nearest_.a);
      const std::uint32_t b = set_->number(body_b_, other.b), least_b = set_->number(body_b_, nearest_.b);
      if (a != least_a ? a > least_a : b >= least_b) return;
    }
    nearest_ = other;
  }

  PlacedBodies bodies_;
  const BodySetView* set_;
  std::uint32_t body_a_, body_b_;
  float stop_below_;
  NearestSpheres nearest_;
  Leaves leaves_;
  static constexpr std::uint32_t max_bounds = 2 * Leaves::max_leaves;
  float origins_apart_;  ///< along the axis of extents
  float extent_a_[Leaves::max_leaves], extent_b_[Leaves::max_leaves + Leaves::padding];
  float bound_[max_bounds + Leaves::padding];         ///< of pairs of nodes, row by row
  std::uint16_t near_[max_bounds + Leaves::padding];  ///< indices of bounds
  alignas(64) float gaps_[64];                        ///< of two blocks
};

}  // namespace bch::detail
