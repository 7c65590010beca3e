// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/isa/kernel_table.hpp"

namespace bch::detail {
namespace {

struct ScalarLanes : Lanes<Scalar, ScalarLanes> {
  struct Guard {};
  static double gather(const double* p, const std::uint32_t* index) noexcept { return p[*index]; }
  static std::uint32_t gather(const std::uint32_t* p, const std::uint32_t* index) noexcept {
    return p[*index];
  }
  static float to_float(const double (&v)[1]) noexcept { return static_cast<float>(v[0]); }
  static void to_double(float v, double (&to)[1]) noexcept { to[0] = static_cast<double>(v); }
  static std::uint32_t bits(bool hit) noexcept { return hit; }
  static float least(float values) noexcept { return values; }
  static constexpr float approximation_error = 0;
  static float approximate_sqrt(float x) noexcept { return __builtin_sqrtf(x); }
};

}  // namespace

extern const Kernels scalar_kernels;
constinit const Kernels scalar_kernels = kernel_table<ScalarLanes>;

}  // namespace bch::detail
