// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <iterator>

#include "layout/base/processor.hpp"

namespace bch::detail {

/// Describes an instruction set for which code was compiled.
struct InstructionSet {
  const char* name;
  bool (*supported)() noexcept;  ///< whether this processor and its operating system support it
};

constexpr bool everywhere() noexcept {
  return true;
}
constexpr InstructionSet scalar{"scalar", everywhere};

#if BCH_X86
// The compiler's test also asks whether the operating system saves the wide registers; xsimd 8.1's does not.
constexpr InstructionSet avx512{"avx512", []() noexcept { return __builtin_cpu_supports("avx512f") != 0; }};
constexpr InstructionSet avx2{"avx2", []() noexcept { return __builtin_cpu_supports("avx2") != 0; }};
constexpr InstructionSet sse2{"sse2", everywhere};
/// The instruction set of BaseLanes, which every processor of this architecture has.
constexpr InstructionSet base = sse2;
#elif BCH_NEON
constexpr InstructionSet neon{"neon", everywhere};
constexpr InstructionSet base = neon;
#elif defined(__wasm_simd128__)
constexpr InstructionSet simd128{"simd128", everywhere};
constexpr InstructionSet base = simd128;
#else
constexpr InstructionSet base = scalar;
#endif

/// Returns the first supported entry of a table of implementations, which lists the best first.
template <class Table>
const auto& first_supported(const Table& table) noexcept {
  return *std::find_if(std::begin(table), std::end(table), [](const auto& row) { return row.supported(); });
}

}  // namespace bch::detail
