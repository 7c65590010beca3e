// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/arguments.hpp"
#include "layout/rounding.hpp"
#include "layout/shape_set_view.hpp"

namespace bch::kernel {

/// Whether agents are what a query may be asked about, array by array, without a branch, so that the compiler uses
/// the registers of the instruction set that `Simd` stands for.
template <class Simd>
class AgentCheck {
 public:
  static bool passes(const Arguments& in, std::size_t begin, std::size_t end) noexcept {
    std::uint32_t bad = any_from(in.agent_shape, begin, end, in.shapes->shape_count);
    bad |= any_beyond(in.agent_x, begin, end, rounding::largest_position);
    bad |= any_beyond(in.agent_y, begin, end, rounding::largest_position);
    bad |= any_beyond(in.agent_heading, begin, end, rounding::largest_heading);
    if (in.agent_level) bad |= any_from(in.agent_level, begin, end, in.shapes->level_count);
    return bad == 0;
  }

 private:
  static std::uint32_t any_beyond(const double* values, std::size_t begin, std::size_t end,
                                  double limit) noexcept {
    std::uint64_t beyond = 0;
    for (std::size_t i = begin; i < end; ++i) beyond += !(__builtin_fabs(values[i]) <= limit);
    return beyond != 0;
  }

  template <class Index>
  static std::uint32_t any_from(const Index* values, std::size_t begin, std::size_t end,
                                std::uint32_t limit) noexcept {
    std::uint32_t from = 0;
    for (std::size_t i = begin; i < end; ++i) from |= values[i] >= limit;
    return from;
  }
};

}  // namespace bch::kernel
