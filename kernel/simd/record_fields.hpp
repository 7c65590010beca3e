// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "kernel/simd/arguments.hpp"

namespace bch::detail {

/// Holds records of four floats, selected from a table by index, field by field: lane = pair.
template <class Simd>
struct RecordFields {
  alignas(64) float field[4][packet_size];

  static constexpr std::uint32_t records_ahead = 32;  ///< how many records ahead are prefetched

  /// Loads the fields of the records that `index` names, in units of `stride` floats. Whole registers are read, so `index`
  /// has to be padded to them. It is inlined, because small batches call it for one register.
  template <std::size_t stride>
  [[gnu::always_inline]] void load(const float* table, const std::uint32_t* index, std::uint32_t count,
                                   bool prefetch) noexcept {
    for (std::uint32_t k = 0; k < count; k += Simd::width) {
      if (prefetch && k + records_ahead < count)
        for (std::uint32_t i = 0; i < Simd::width; ++i)
          __builtin_prefetch(table + stride * index[k + records_ahead + i]);
      typename Simd::Float fields[4];
      Simd::template load_records<stride>(table, index + k, fields);
      for (std::uint32_t i = 0; i < 4; ++i) Simd::store(field[i] + k, fields[i]);
    }
  }
};

}  // namespace bch::detail
