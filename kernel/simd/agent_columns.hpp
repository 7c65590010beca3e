// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "kernel/simd/arguments.hpp"

namespace bch::detail {

/// Reads the values of agents from the arrays or structs of the caller. (`Simd` keeps instruction sets from sharing a
/// function.)
template <class Simd>
struct AgentColumns {
  template <class Value>
  static Value at(const AgentColumn& column, std::uint64_t agent) noexcept {
    return *reinterpret_cast<const Value*>(column.first + agent * column.stride);
  }
  static double number(const AgentColumn& column, std::uint64_t agent) noexcept {
    return column.is_float ? static_cast<double>(at<float>(column, agent)) : at<double>(column, agent);
  }
  static void prefetch(const AgentColumn& column, std::uint64_t agent) noexcept {
    __builtin_prefetch(column.first + agent * column.stride);
  }

  /// Returns the numbers of a register of agents. Arrays of double are gathered; the branch is the same for a whole batch.
  [[gnu::always_inline]] static auto numbers(const AgentColumn& column,
                                             const std::uint32_t* agents) noexcept {
    if (!column.is_float && column.stride == sizeof(double)) [[likely]]
      return Simd::gather(reinterpret_cast<const double*>(column.first), agents);
    alignas(64) double values[Simd::doubles];
    for (std::uint32_t lane = 0; lane < Simd::doubles; ++lane) values[lane] = number(column, agents[lane]);
    return Simd::load(values);
  }

  /// Copies the integers of as many agents as a register has floats.
  [[gnu::always_inline]] static void copy(const AgentColumn& column, const std::uint32_t* agents,
                                          std::uint32_t* to) noexcept {
    if (column.stride == sizeof(std::uint32_t)) [[likely]] {
      Simd::store(to, Simd::gather(reinterpret_cast<const std::uint32_t*>(column.first), agents));
      return;
    }
    for (std::uint32_t lane = 0; lane < Simd::width; ++lane)
      to[lane] = at<std::uint32_t>(column, agents[lane]);
  }
};

}  // namespace bch::detail
