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
#include "kernel/runtime/agent_check.hpp"
#include "kernel/runtime/kernels.hpp"

namespace bch::detail {

/// Holds all kernels compiled for the lanes of one instruction set. Each holds a
/// Simd::Guard, which cleans up on the way out. `Simd` has to be of an
/// anonymous namespace, so that instruction sets share no function.
template <class Simd>
struct Row {
  using Guard [[maybe_unused]] = typename Simd::Guard;
  /// Names the stages of questions about distances, which are compiled apart, so that collide() does not pay
  /// for what only these need.
  struct WithGaps : Simd {
    static constexpr bool knows_gaps = true;
  };

  static bool check(const Arguments& arguments, std::size_t begin, std::size_t end) noexcept {
    [[maybe_unused]] const Guard guard;
    return AgentCheck<Simd>::passes(arguments, begin, end);
  }
  static AgentRange named(const Pair* pairs, std::size_t begin, std::size_t end) noexcept {
    [[maybe_unused]] const Guard guard;
    return AgentCheck<Simd>::named(pairs, begin, end);
  }
  static void run(const Arguments& arguments, std::size_t begin, std::size_t end) noexcept {
    [[maybe_unused]] const Guard guard;
    PairKernel<Simd>::run(arguments, begin, end);
  }
  static void run_within(const Arguments& arguments, std::size_t begin, std::size_t end) noexcept {
    [[maybe_unused]] const Guard guard;
    PairKernel<WithGaps>::run(arguments, begin, end);
  }
  static void run_bodies(const BodyArguments& arguments, std::size_t begin, std::size_t end) noexcept {
    [[maybe_unused]] const Guard guard;
    BodyKernel<Simd>::run(arguments, begin, end);
  }
  static void body_clearance(const BodyClearanceArguments& arguments, std::size_t begin,
                             std::size_t end) noexcept {
    [[maybe_unused]] const Guard guard;
    BodyClearanceKernel<Simd>::run(arguments, begin, end);
  }
  static bool run_if_valid(const Arguments& arguments, std::uint32_t count) noexcept {
    [[maybe_unused]] const Guard guard;
    return PairKernel<Simd>::run_if_valid(arguments, count);
  }
  static void count_contacts(const Arguments& arguments, std::size_t begin, std::size_t end,
                             std::uint64_t* counts) noexcept {
    [[maybe_unused]] const Guard guard;
    ContactKernel<Simd>::count(arguments, begin, end, counts);
  }
  static std::size_t append_contacts(const Arguments& arguments, std::size_t begin, std::size_t end,
                                     std::uint64_t* offsets, DiscPair* contacts,
                                     std::uint64_t room) noexcept {
    [[maybe_unused]] const Guard guard;
    return ContactKernel<Simd>::append(arguments, begin, end, offsets, contacts, room);
  }
  static void fill_contacts(const Arguments& arguments, std::size_t begin, std::size_t end,
                            const std::uint64_t* offsets, DiscPair* contacts) noexcept {
    [[maybe_unused]] const Guard guard;
    ContactKernel<Simd>::fill(arguments, begin, end, offsets, contacts);
  }
  static void extents(const CutDiscs& discs, const float* axis_x, const float* axis_y, std::uint32_t axes,
                      float* low, float* high) noexcept {
    [[maybe_unused]] const Guard guard;
    ExtentKernel<Simd>::run(discs, axis_x, axis_y, axes, low, high);
  }
  static void clearance(const ClearanceArguments& arguments, std::size_t begin, std::size_t end) noexcept {
    [[maybe_unused]] const Guard guard;
    ClearanceKernel<Simd>::run(arguments, begin, end);
  }
  static void time_of_impact(const TimeOfImpactArguments& arguments, std::size_t begin,
                             std::size_t end) noexcept {
    [[maybe_unused]] const Guard guard;
    TimeOfImpactKernel<Simd>::run(arguments, begin, end);
  }
  static std::uint32_t overlapping_boxes(const BoxBlock* blocks, const Box* queries, const BoxHit* in,
                                         std::uint32_t count, BoxHit* out) noexcept {
    [[maybe_unused]] const Guard guard;
    return BoxQuery<Simd>::run(blocks, queries, in, count, out);
  }
  static bool touches(const ObstacleArguments& arguments) noexcept {
    [[maybe_unused]] const Guard guard;
    return ObstacleKernel<Simd>(arguments).touches();
  }
  static void find_gap(const ObstacleArguments& arguments, double enough, ObstacleGap& best) noexcept {
    [[maybe_unused]] const Guard guard;
    ObstacleKernel<Simd>(arguments).find_gap(enough, best);
  }

  static constexpr Kernels kernels{Simd::width,
                                   check,
                                   named,
                                   run,
                                   run_within,
                                   run_bodies,
                                   body_clearance,
                                   run_if_valid,
                                   count_contacts,
                                   append_contacts,
                                   fill_contacts,
                                   extents,
                                   clearance,
                                   time_of_impact,
                                   overlapping_boxes,
                                   touches,
                                   find_gap};
};

}  // namespace bch::detail
