// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include <bch/agents.hpp>

#include "kernel/runtime/kernels.hpp"
#include "kernel/simd/agent_columns.hpp"
#include "kernel/simd/arguments.hpp"
#include "layout/base/heading.hpp"
#include "layout/base/rounding.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Defines which agents are valid arguments of a query, and tests that. It has no branch, so that the compiler vectorises it for
/// the instruction set of `Simd`.
template <class Simd>
class AgentCheck {
 public:
  static bool passes(const Arguments& in, std::size_t begin, std::size_t end) noexcept {
    static_assert(rounding::largest_position == rounding::largest_heading);
    return all_below<std::uint32_t>(in.agent_shape, begin, end, in.shapes->shape_count) &
           all_within(in.agent_x, begin, end) & all_within(in.agent_y, begin, end) &
           all_within(in.agent_heading, begin, end) &
           (in.agent_heading_y.first == nullptr || all_unit(in, begin, end)) &
           (in.agent_z.first == nullptr || all_within(in.agent_z, begin, end)) &
           (in.agent_level.first == nullptr ||
            all_below<std::uint8_t>(in.agent_level, begin, end, in.shapes->level_count));
  }

  static AgentRange named(const Pair* pairs, std::size_t begin, std::size_t end) noexcept {
    // First and second agents separately, in the order of memory.
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
  /// Calls use(value(i)) for agents begin .. end; for contiguous values in a loop that the compiler vectorises.
  template <class Value, class Use>
  static void for_all(const AgentColumn& column, std::size_t begin, std::size_t end,
                      const Use& use) noexcept {
    if (column.stride == sizeof(Value)) {
      const auto* const values = reinterpret_cast<const Value*>(column.first);
      for (std::size_t i = begin; i < end; ++i) use(values[i]);
    } else {
      for (std::size_t i = begin; i < end; ++i) use(AgentColumns<Simd>::template at<Value>(column, i));
    }
  }

  static bool all_within(const AgentColumn& numbers, std::size_t begin, std::size_t end) noexcept {
    std::uint64_t beyond = 0;
    const auto count = [&](double value) {
      beyond += !(__builtin_fabs(value) <= rounding::largest_position);
    };
    if (numbers.is_float)
      for_all<float>(numbers, begin, end, [&](float value) { count(static_cast<double>(value)); });
    else
      for_all<double>(numbers, begin, end, count);
    return beyond == 0;
  }

  static bool all_unit(const Arguments& in, std::size_t begin, std::size_t end) noexcept {
    std::uint64_t other = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const double x = AgentColumns<Simd>::number(in.agent_heading, i),
                   y = AgentColumns<Simd>::number(in.agent_heading_y, i), square = x * x + y * y;
      other += !(heading_constants::least_square <= square && square <= heading_constants::largest_square);
    }
    return other == 0;
  }

  template <class Index>
  static bool all_below(const AgentColumn& indices, std::size_t begin, std::size_t end,
                        std::uint32_t limit) noexcept {
    std::uint32_t from = 0;
    for_all<Index>(indices, begin, end, [&](Index index) { from |= index >= limit; });
    return from == 0;
  }
};

}  // namespace bch::detail
