// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

namespace bch::detail {

/// Names the stages of the pair kernel.
enum class Stage : std::uint8_t {
  place,
  profiles,
  even_supports,
  inscribed_four,
  inscribed_eight,
  odd_supports,
  add,     ///< of undecided pairs to the traversal
  blocks,  ///< of the traversal: tests of two blocks, and steps to the next
  leaves,  ///< of the traversal: segments and ancestors
};
constexpr unsigned stage_count = 9;

/// Reports the end of a stage, and how many tests it made, in kernels compiled to be measured (bench/ratios/counted_kernel.hpp).
/// Others have no code for it.
template <class Simd>
[[gnu::always_inline]] inline void end_stage([[maybe_unused]] Stage stage,
                                             [[maybe_unused]] std::uint32_t tests) noexcept {
  if constexpr (requires { Simd::end_stage(stage, tests); }) Simd::end_stage(stage, tests);
}

}  // namespace bch::detail
