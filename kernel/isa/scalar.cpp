// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/collide/pair_kernel.hpp"
#include "kernel/contact/contact_kernel.hpp"
#include "kernel/distance/clearance_kernel.hpp"
#include "kernel/distance/time_of_impact_kernel.hpp"
#include "kernel/penetration/extent_kernel.hpp"
#include "kernel/runtime/agent_check.hpp"

namespace bch::kernel {
namespace {

struct ScalarLanes : Lanes<Scalar> {
  static double gather(const double* p, const std::uint32_t* index) noexcept { return p[*index]; }
  static std::uint32_t gather(const std::uint32_t* p, const std::uint32_t* index) noexcept {
    return p[*index];
  }
  static float rounded(const double (&v)[1]) noexcept { return static_cast<float>(v[0]); }
  static void widened(float v, double (&to)[1]) noexcept { to[0] = static_cast<double>(v); }
  static std::uint32_t bits(bool hit) noexcept { return hit; }
  static float least(float values) noexcept { return values; }
  static constexpr float rough = 0;
  static float rough_root(float x) noexcept { return __builtin_sqrtf(x); }
};

}  // namespace

bool check_scalar(const Arguments& arguments, std::size_t begin, std::size_t end) noexcept {
  return AgentCheck<ScalarLanes>::passes(arguments, begin, end);
}

AgentRange named_scalar(const Pair* pairs, std::size_t begin, std::size_t end) noexcept {
  return AgentCheck<ScalarLanes>::named(pairs, begin, end);
}

void run_scalar(const Arguments& arguments, std::size_t begin, std::size_t end) noexcept {
  PairKernel<ScalarLanes>::run(arguments, begin, end);
}

bool run_if_valid_scalar(const Arguments& arguments, std::uint32_t count) noexcept {
  return PairKernel<ScalarLanes>::run_if_valid(arguments, count);
}

void count_contacts_scalar(const Arguments& arguments, std::size_t begin, std::size_t end,
                           std::uint64_t* counts) noexcept {
  ContactKernel<ScalarLanes>::count(arguments, begin, end, counts);
}

void fill_contacts_scalar(const Arguments& arguments, std::size_t begin, std::size_t end,
                          const std::uint64_t* offsets, DiscPair* contacts) noexcept {
  ContactKernel<ScalarLanes>::fill(arguments, begin, end, offsets, contacts);
}

void extents_scalar(const CutDiscs& discs, const float* axis_x, const float* axis_y, std::uint32_t axes,
                    float* low, float* high) noexcept {
  ExtentKernel<ScalarLanes>::run(discs, axis_x, axis_y, axes, low, high);
}

void clearance_scalar(const ClearanceArguments& arguments, std::size_t begin, std::size_t end) noexcept {
  ClearanceKernel<ScalarLanes>::run(arguments, begin, end);
}

void time_of_impact_scalar(const TimeOfImpactArguments& arguments, std::size_t begin,
                           std::size_t end) noexcept {
  TimeOfImpactKernel<ScalarLanes>::run(arguments, begin, end);
}

}  // namespace bch::kernel
