// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include <bch/agents.hpp>

#include "kernel/runtime/kernels.hpp"
#include "kernel/simd/arguments.hpp"
#include "layout/base/rounding.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Checks whether agents are valid arguments of a query, which is defined here. It has no branch, so that the compiler
/// uses the registers of the instruction set that `Simd` stands for.
template <class Simd>
class AgentCheck {
 public:
  static bool passes(const Arguments& in, std::size_t begin, std::size_t end) noexcept {
    return all_below(in.agent_shape, begin, end, in.shapes->shape_count) &
           all_within(in.agent_x, in.agent_y, in.agent_heading, begin, end) &
           (in.agent_z == nullptr || all_within(in.agent_z, begin, end)) &
           (in.agent_level == nullptr || all_below(in.agent_level, begin, end, in.shapes->level_count));
  }

  static AgentRange named(const Pair* pairs, std::size_t begin, std::size_t end) noexcept {
    // Firsts and seconds apart, as they lie in memory.
    std::uint32_t low[] = {~std::uint32_t{0}, ~std::uint32_t{0}}, high[] = {0, 0};
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t each[] = {pairs[i].first, pairs[i].second};
      for (int k = 0; k < 2; ++k) {
        low[k] = each[k] < low[k] ? each[k] : low[k];
        high[k] = high[k] < each[k] ? each[k] : high[k];
      }
    }
    return {low[0] < low[1] ? low[0] : low[1], high[0] < high[1] ? high[1] : high[0]};
  }

 private:
  static bool all_within(const double* x, const double* y, const double* heading, std::size_t begin,
                         std::size_t end) noexcept {
    std::uint64_t beyond = 0;
    for (std::size_t i = begin; i < end; ++i) {
      beyond += !(__builtin_fabs(x[i]) <= rounding::largest_position);
      beyond += !(__builtin_fabs(y[i]) <= rounding::largest_position);
      beyond += !(__builtin_fabs(heading[i]) <= rounding::largest_heading);
    }
    return beyond == 0;
  }

  static bool all_within(const double* z, std::size_t begin, std::size_t end) noexcept {
    std::uint64_t beyond = 0;
    for (std::size_t i = begin; i < end; ++i) beyond += !(__builtin_fabs(z[i]) <= rounding::largest_position);
    return beyond == 0;
  }

  template <class Index>
  static bool all_below(const Index* values, std::size_t begin, std::size_t end,
                        std::uint32_t limit) noexcept {
    std::uint32_t from = 0;
    for (std::size_t i = begin; i < end; ++i) from |= values[i] >= limit;
    return from == 0;
  }
};

}  // namespace bch::detail
