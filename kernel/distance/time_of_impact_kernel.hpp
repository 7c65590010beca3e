// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/distance/time_of_impact_arguments.hpp"
#include "kernel/distance/time_of_impact_measure.hpp"
#include "kernel/distance/time_of_impact_traversal.hpp"
#include "kernel/simd/packet_pairs.hpp"
#include "kernel/simd/relative_transforms.hpp"
#include "kernel/simd/separating_axis_test.hpp"

namespace bch::detail {

/// Finds the first contact of every pair, none of which collides at the start. For each packet of pairs the
/// kernel places B in A's frame, rejects by supports the pairs that a line separates during the whole
/// displacement, and traverses the trees of the rest.
template <class Simd>
class TimeOfImpactKernel {
 public:
  static void run(const TimeOfImpactArguments& arguments, std::size_t begin, std::size_t end) noexcept {
    static_assert(sizeof(TimeOfImpactKernel) <= 256 * 1024, "what query.hpp promises, and room for calls");
    TimeOfImpactKernel kernel(arguments);
    for (; begin < end; begin += packet_size) kernel.answer_packet(begin, end);
    kernel.traversal_.run(0);
  }

 private:
  using Measure = TimeOfImpactMeasure<Simd>;

  explicit TimeOfImpactKernel(const TimeOfImpactArguments& arguments) noexcept
      : arguments_(arguments),
        shapes_(*arguments.in.shapes),
        axis_test_(shapes_, transforms_),
        traversal_(shapes_.nodes, arguments.time) {}

  void answer_packet(std::size_t begin, std::size_t end) noexcept {
    transforms_.compute(arguments_.in, begin, end);
    const std::uint32_t size = transforms_.size;
    rotate_displacements(arguments_.x + begin, arguments_.y + begin);
    float* const time = arguments_.time + begin;
    open_.size = 0;
    for (std::uint32_t k = 0; k < size; ++k) {
      time[k] = __builtin_inff();
      open_.add_if((x_[k] != 0) | (y_[k] != 0), k);
    }
    if (shapes_.trees == nullptr) {
      for (std::uint32_t k = 0; k < open_.size; ++k) time[open_.pair[k]] = time_of_roots(open_.pair[k]);
      return;
    }
    if (shapes_.support != nullptr && open_.size != 0) reject_by_supports();
    for (std::uint32_t k = 0; k < open_.size; ++k) {
      const std::uint32_t pair = open_.pair[k];
      traversal_.add(begin + pair, transforms_.transform(pair), shapes_.trees[transforms_.root_a[pair]],
                     shapes_.trees[transforms_.root_b[pair]], Measure(x_[pair], y_[pair], farthest(pair)));
    }
  }

  /// Rotates the displacements into A's frame.
  void rotate_displacements(const float* x, const float* y) noexcept {
    for (std::uint32_t k = 0; k < transforms_.size; ++k) {
      const auto [cosine, sine] = transforms_.heading(k);
      x_[k] = cosine * x[k] + sine * y[k];
      y_[k] = cosine * y[k] - sine * x[k];
    }
  }

  /// Rejects pairs that supports along one of A's directions keep apart on the whole way: the even directions first
  /// (`odd` = 0), then the odd ones (`odd` = 1).
  void reject_by_supports() noexcept {
    if (!shapes_.rows_follow_roots) {
      for (std::uint32_t k = 0; k < transforms_.size; ++k)
        row_a_[k] = shapes_.roots[transforms_.root_a[k]].row,
        row_b_[k] = shapes_.roots[transforms_.root_b[k]].row;
      axis_test_.use_rows(row_a_, row_b_);
    }
    axis_test_.place_directions();
    for (unsigned odd = 0; odd < 2; ++odd)
      open_.drop_if(
          open_,
          [this, odd](std::uint32_t pair) {
            return axis_test_.apart_on_the_way(pair, odd, x_[pair], y_[pair], slack(pair));
          },
          [](std::uint32_t) {});
  }

  /// Returns the slack of supports during the displacement v, beyond the margin that layout/base/rounding.hpp
  /// includes in supports. As there, S is the sum of both extents, t the position of B in A's frame, D the
  /// distance of two centres, and u = 2^-24. The slack has four parts:
  ///
  ///     (1) discs may protrude from the outlines that supports belong to: `excess`
  ///     (2) TimeOfImpactMeasure lets discs touch up to 16 u D farther apart than collide()'s test does;
  ///         with D <= S + |t| that is 16 u S + 16 u |t|
  ///     (3) the product of v and a direction is off by 3 u |v|, the differences by 2 u (|t| + |v|)
  ///     (4) where discs touch on the way, |t| may be 2 S + |v|, but rounding.hpp has |t| <= 2 S. Its errors
  ///         in t are 10.6 u |t| in supports, (position) and the product, and 5.6 u |t| in discs, (position)
  ///         and (sum). So the additional |v| costs 16.2 u |v|
  ///
  /// (2) to (4) together are 16 u S + 18 u |t| + 22 u |v|. relative_error = 64 u exceeds these three factors.
  /// Only the proof needs (2) to (4): supports have more margin than tests have found necessary.
  float slack(std::uint32_t pair) const noexcept {
    constexpr float relative_error = 0x1p-18f;
    static_assert(double{relative_error} >= 30 * rounding::unit_roundoff, "above the factors of (2) to (4)");
    const float excess = shapes_.profiles[transforms_.shape_a[pair]].excess +
                         shapes_.profiles[transforms_.shape_b[pair]].excess;
    return excess + relative_error * (max_extent(pair) + __builtin_fabsf(transforms_.tx[pair]) +
                                      __builtin_fabsf(transforms_.ty[pair]) + __builtin_fabsf(x_[pair]) +
                                      __builtin_fabsf(y_[pair]));
  }

  float max_extent(std::uint32_t pair) const noexcept {
    return shapes_.max_extent[transforms_.shape_a[pair]] + shapes_.max_extent[transforms_.shape_b[pair]];
  }

  /// Returns an upper bound of the distance between centres of discs of the two shapes. A centre may be the centre of
  /// a box around other discs. Its distance from the shape's origin is then at most sqrt(2) times the shape's extent;
  /// the factor 2 is more than that.
  float farthest(std::uint32_t pair) const noexcept {
    return 2 * max_extent(pair) + __builtin_fabsf(transforms_.tx[pair]) +
           __builtin_fabsf(transforms_.ty[pair]);
  }

  /// Returns the time of a pair in a set of single discs.
  float time_of_roots(std::uint32_t pair) const noexcept {
    const Root &a = shapes_.roots[transforms_.root_a[pair]], &b = shapes_.roots[transforms_.root_b[pair]];
    const auto [x, y] = transforms_.transform(pair).apply(b.x, b.y);
    Measure measure(x_[pair], y_[pair], 0);
    measure.update(
        Measure::template time_of<double>(x - a.x, y - a.y, a.radius + b.radius, x_[pair], y_[pair]));
    return measure.time();
  }

  const TimeOfImpactArguments& arguments_;
  const ShapeSetView shapes_;
  alignas(64) float x_[packet_size], y_[packet_size];  ///< the packet's displacements
  RelativeTransforms<Simd> transforms_;
  SeparatingAxisTest<Simd> axis_test_;
  std::uint32_t row_a_[packet_size], row_b_[packet_size];  ///< rows of supports; unused if rows_follow_roots
  PacketPairs<Simd, packet_size> open_;
  TimeOfImpactTraversal<Simd> traversal_;
};

}  // namespace bch::detail
