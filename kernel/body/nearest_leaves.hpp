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
  /// Takes two bodies, whose gap is the limit, and the numbers of their spheres. `enough`: see BodyClearanceArguments.
  void begin(const PlacedBodies& bodies, const BodySetView& set, std::uint32_t body_a, std::uint32_t body_b,
             float enough) noexcept {
    bodies_ = bodies, set_ = &set, body_a_ = body_a, body_b_ = body_b, enough_ = enough;
    nearest_ = {bodies.gap, no_slot, no_slot};
  }

  /// Bounds the distance by the core spheres. Returns whether that is enough.
  bool bound_by_cores() noexcept {
    for (unsigned i = 0; i < core_spheres; i += 8)
      for (unsigned j = 0; j < core_spheres; j += 8)
        if (bound_by(core_of(bodies_.a, i), core_of(bodies_.b, j)) && enough_ >= 0) return true;
    return false;
  }

  /// Returns the bodies; their gap is a bound of the distance, and the least so far.
  const PlacedBodies& bodies() const noexcept { return bodies_; }

  /// Searches the leaves that reach the other body.
  NearestSpheres search(const Reach& reach_a, const Reach& reach_b) noexcept {
    if (!leaves_.clip(bodies_, &reach_a, &reach_b, 1)) return nearest_;
    measure_nearest_nodes();
    for (std::uint32_t row = 0; row < leaves_.rows && !is_done(); ++row) measure_row(row);
    return nearest_;
  }

 private:
  using Float = typename Simd::Float;
  using Mask = typename Simd::Mask;

  bool is_done() const noexcept { return bodies_.gap <= enough_; }

  /// Bounds the distance by that of 8 x 8 spheres, which need not be exact. Returns whether some overlap.
  [[gnu::noinline]] bool bound_by(Balls a, Balls b) noexcept {
    constexpr float longer = (1 + 2 * Simd::rough) * (1 + 0x1p-20f);  // than the root, and far_centres
    Float least(bodies_.gap);
    Mask overlap = Float(1.0f) < Float(0.0f);
    visit_ball_pairs<Simd, 8>(
        bodies_.b_in_a, a, b, [&](unsigned, const SpheresOf<Float>& of_a, const SpheresOf<Float>& of_b) {
          const Float square = square_between(of_a, of_b), radii = of_a.radius + of_b.radius;
          overlap = overlap | (square <= radii * radii);
          least = xsimd::min(least, rough_root<Simd>(square) * Float(longer) - radii);
        });
    bodies_.gap = Simd::least(least);
    return Simd::bits(overlap) != 0;
  }
  using Leaves = ClippedLeaves<Simd>;

  /// Holds how far nodes are apart on the ground and in height; below 0 where they overlap.
  struct Apart {
    Float across, up;
  };
  Apart apart(const typename Leaves::Node& node, std::uint32_t k) const noexcept {
    const Float dx = Simd::load(leaves_.x + k) - node.x, dy = Simd::load(leaves_.y + k) - node.y;
    const Float length = rough_root<Simd>(dx * dx + dy * dy) * Float(1 - Simd::rough);
    return {length - (Simd::load(leaves_.radius + k) + node.radius),
            xsimd::max(node.bottom - Simd::load(leaves_.top + k), Simd::load(leaves_.bottom + k) - node.top)};
  }

  /// Measures the leaves whose nodes are nearest, so that the distance soon is nearly what it will be.
  void measure_nearest_nodes() noexcept {
    const Float infinite(__builtin_inff());
    float least = __builtin_inff();
    std::uint32_t least_row = 0, least_column = 0;
    for (std::uint32_t row = 0; row < leaves_.rows; ++row) {
      const auto node = leaves_.node(bodies_.a, leaves_.leaf_a[row]);
      for (std::uint32_t k = 0; k < leaves_.columns; k += Simd::width) {
        const auto [across, up] = apart(node, k);
        // Nodes behind the last one are infinitely far away, or NaN.
        const Float bound = Simd::select(across < infinite, xsimd::max(across, up), infinite);
        const std::uint32_t less = Simd::bits(bound < Float(least));
        if (less == 0) continue;
        least = Simd::least(bound);
        least_row = row;
        least_column = k + static_cast<std::uint32_t>(__builtin_ctz(Simd::bits(bound <= Float(least))));
      }
    }
    if (least < __builtin_inff()) measure(leaves_.leaf_a[least_row], leaves_.leaf_b[least_column]);
  }

  /// Measures the leaves of a row whose nodes are near enough.
  void measure_row(std::uint32_t row) noexcept {
    const auto node = leaves_.node(bodies_.a, leaves_.leaf_a[row]);
    const float margin = bodies_.margin();
    const Float most(margin), square(margin * margin), zero(0.0f);
    std::uint32_t size = 0;
    for (std::uint32_t k = 0; k < leaves_.columns; k += Simd::width) {
      const auto [across, up] = apart(node, k);
      const Float beside = xsimd::max(across, zero), above = xsimd::max(up, zero);
      const Mask near = (across <= most) & (up <= most) & (beside * beside + above * above <= square);
      size += Simd::write_set(Simd::bits(near), k, near_ + size);
    }
    for (std::uint32_t i = 0; i < size; ++i) measure(leaves_.leaf_a[row], leaves_.leaf_b[near_[i]]);
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
      for (unsigned k = 0; k < count * count; ++k)
        if (gaps_[k] == least) offer({least, slot(a, leaf_a, i + k / count), slot(b, leaf_b, j + k % count)});
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
  float enough_;
  NearestSpheres nearest_;
  Leaves leaves_;
  std::uint16_t near_[Leaves::most_leaves + Leaves::padding];  ///< columns of a row
  alignas(64) float gaps_[64];                                 ///< of two blocks
};

}  // namespace bch::detail
