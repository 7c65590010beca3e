// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <xmmintrin.h>

#include <cstdint>

namespace bch::kernel {

/// Records of four floats, picked by index, field by field: what lanes that stand for pairs need of tables. Four
/// records at a time, because a record fills a register of the baseline. (Intrinsics, not xsimd: its batch for the
/// baseline would be one inline function in every instruction set's object, and the linker keeps any of them.)
template <class Simd, std::uint32_t capacity>
struct RecordFields {
  static_assert(capacity % 4 == 0);
  alignas(64) float first[capacity], second[capacity], third[capacity], fourth[capacity];

  /// Whole fours are read: `index` has to go on that far.
  template <class Record>
  void load(const Record* table, const std::uint32_t* index, std::uint32_t count) noexcept {
    static_assert(sizeof(Record) == 4 * sizeof(float));
    for (std::uint32_t k = 0; k < count; k += 4) {
      __m128 r0 = record(table + index[k]), r1 = record(table + index[k + 1]),
             r2 = record(table + index[k + 2]), r3 = record(table + index[k + 3]);
      _MM_TRANSPOSE4_PS(r0, r1, r2, r3);
      _mm_store_ps(first + k, r0);
      _mm_store_ps(second + k, r1);
      _mm_store_ps(third + k, r2);
      _mm_store_ps(fourth + k, r3);
    }
  }

 private:
  template <class Record>
  static __m128 record(const Record* at) noexcept {
    return _mm_load_ps(&at->x);
  }
};

}  // namespace bch::kernel
