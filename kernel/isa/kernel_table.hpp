// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "kernel/body/body_clearance_kernel.hpp"
#include "kernel/body/body_kernel.hpp"
#include "kernel/collide/pair_kernel.hpp"
#include "kernel/contact/contact_kernel.hpp"
#include "kernel/distance/clearance_kernel.hpp"
#include "kernel/distance/time_of_impact_kernel.hpp"
#include "kernel/obstacles/box_query.hpp"
#include "kernel/obstacles/obstacle_kernel.hpp"
#include "kernel/penetration/extent_kernel.hpp"
#include "kernel/penetration/free_kernel.hpp"
#include "kernel/runtime/agent_check.hpp"
#include "kernel/runtime/kernels.hpp"

namespace bch::detail {

/// Marks the stages of within(), which are compiled separately, so that collide() does not pay for gaps.
template <class Simd>
struct WithGaps : Simd {
  static constexpr bool knows_gaps = true;
};

/// Calls a kernel, and resets the registers afterwards: see Simd::Guard.
template <class Simd, auto kernel>
struct Guarded;
template <class Simd, class Answer, class... Parameters, Answer (*kernel)(Parameters...) noexcept>
struct Guarded<Simd, kernel> {
  static Answer call(Parameters... parameters) noexcept {
    [[maybe_unused]] const typename Simd::Guard guard;
    return kernel(parameters...);
  }
};

/// Selects the lanes of kernels that go through leaves of eight: `Simd`, or narrower ones that it names, because registers
/// that are half empty take longer.
template <class Simd>
struct LeafLanes {
  using Type = Simd;
};
template <class Simd>
requires requires {
  typename Simd::OfLeaves;
}
struct LeafLanes<Simd> {
  using Type = typename Simd::OfLeaves;
};
template <class Simd>
using FreeKernelFor = FreeKernel<typename LeafLanes<Simd>::Type>;

/// Holds all kernels, compiled for the lanes of one instruction set. `Simd` has to be in an anonymous namespace, so that
/// instruction sets share no function.
template <class Simd>
constexpr Kernels kernel_table{
    .width = Simd::width,
    .check = Guarded<Simd, &AgentCheck<Simd>::passes>::call,
    .named = Guarded<Simd, &AgentCheck<Simd>::named>::call,
    .run = Guarded<Simd, &PairKernel<Simd>::run>::call,
    .run_within = Guarded<Simd, &PairKernel<WithGaps<Simd>>::run>::call,
    .run_bodies = Guarded<Simd, &BodyKernel<Simd>::run>::call,
    .body_clearance = Guarded<Simd, &BodyClearanceKernel<Simd>::run>::call,
    .count_contacts = Guarded<Simd, &ContactKernel<Simd>::count>::call,
    .append_contacts = Guarded<Simd, &ContactKernel<Simd>::append>::call,
    .fill_contacts = Guarded<Simd, &ContactKernel<Simd>::fill>::call,
    .extents = Guarded<Simd, &ExtentKernel<Simd>::run>::call,
    .free_place = Guarded<Simd, &FreeKernelFor<Simd>::place>::call,
    .free_bound = Guarded<Simd, &FreeKernelFor<Simd>::bound>::call,
    .free_turn = Guarded<Simd, &FreeKernelFor<Simd>::turn>::call,
    .free_next = Guarded<Simd, &FreeKernelFor<Simd>::next>::call,
    .clearance = Guarded<Simd, &ClearanceKernel<Simd>::run>::call,
    .time_of_impact = Guarded<Simd, &TimeOfImpactKernel<Simd>::run>::call,
    .overlapping_boxes = Guarded<Simd, &BoxQuery<Simd>::run>::call,
    .touches = Guarded<Simd, &ObstacleKernel<Simd>::touches>::call,
    .find_gap = Guarded<Simd, &ObstacleKernel<Simd>::find_gap>::call,
};

}  // namespace bch::detail
