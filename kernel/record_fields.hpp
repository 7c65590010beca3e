// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

namespace bch::kernel {

/// Records of four floats, picked from a table by index, field by field: what lanes that stand for pairs need
/// of tables.
template <class Simd, std::uint32_t capacity>
struct RecordFields {
  alignas(64) float field[4][capacity];

  static constexpr std::uint32_t records_ahead = 32;  ///< that are asked for, with `prefetch`

  /// Whole registers are read: `index` has to go on that far.
  void load(const float* table, const std::uint32_t* index, std::uint32_t count, bool prefetch) noexcept {
    for (std::uint32_t k = 0; k < count; k += Simd::width) {
      if (prefetch && k + records_ahead < count)
        for (std::uint32_t i = 0; i < Simd::width; ++i)
          __builtin_prefetch(table + std::size_t{4} * index[k + records_ahead + i]);
      typename Simd::Float fields[4];
      Simd::load_records(table, index + k, fields);
      for (std::uint32_t i = 0; i < 4; ++i) Simd::store(field[i] + k, fields[i]);
    }
  }
};

}  // namespace bch::kernel
