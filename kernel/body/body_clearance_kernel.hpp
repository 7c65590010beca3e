// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/body/band_test.hpp"
#include "kernel/body/body_clearance_arguments.hpp"
#include "kernel/body/nearest_leaves.hpp"
#include "kernel/simd/relative_transforms.hpp"

namespace bch::detail {

/// Finds the nearest spheres of every pair of bodies. Packet by packet: places B in A's frame, leaves out pairs that a line or a height
/// keeps farther apart than the limit, and searches the leaves of the rest, one pair after the other.
template <class Simd>
class BodyClearanceKernel {
 public:
  static void run(const BodyClearanceArguments& arguments, std::size_t begin, std::size_t end) noexcept {
    static_assert(sizeof(BodyClearanceKernel) <= 256 * 1024, "what Kernels promises");
    BodyClearanceKernel kernel(arguments);
    for (; begin < end; begin += packet_size) {
      kernel.transforms_.compute(arguments.in.pairs, begin, end);
      kernel.bands_.place();
      for (std::uint32_t pair = 0; pair < kernel.transforms_.size; ++pair)
        arguments.nearest[begin + pair] = kernel.answer(pair);
    }
  }

 private:
  explicit BodyClearanceKernel(const BodyClearanceArguments& arguments) noexcept
      : arguments_(arguments), bands_(transforms_) {}

  NearestSpheres answer(std::uint32_t pair) noexcept {
    const BodySetView& set = *arguments_.in.bodies;
    PlacedBodies bodies = placed_bodies(arguments_.in, transforms_, pair);
    bodies.gap = arguments_.limit;
    Reach of_a, of_b;
    if (!(bands_.find_reach_of_all(pair, bodies, of_a, of_b) <= bodies.margin()))
      return {bodies.gap, no_slot, no_slot};
    leaves_.begin(bodies, set, transforms_.shape_a[pair], transforms_.shape_b[pair], arguments_.stop_below);
    if (leaves_.bound_by_cores()) return {arguments_.stop_below, 0, 0};
    of_a.widen(leaves_.bodies().margin()), of_b.widen(leaves_.bodies().margin());
    return leaves_.search(of_a, of_b);
  }

  const BodyClearanceArguments& arguments_;
  RelativeTransforms<Simd> transforms_;
  BandTest<Simd> bands_;
  NearestLeaves<Simd> leaves_;
};

}  // namespace bch::detail
