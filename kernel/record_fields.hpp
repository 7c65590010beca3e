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

  /// Whole registers are read: `index` has to go on that far.
  void load(const float* table, const std::uint32_t* index, std::uint32_t count) noexcept {
    for (std::uint32_t k = 0; k < count; k += Simd::width) {
      typename Simd::Float fields[4];
      Simd::load_records(table, index + k, fields);
      for (std::uint32_t i = 0; i < 4; ++i) Simd::store(field[i] + k, fields[i]);
    }
  }
};

}  // namespace bch::kernel
