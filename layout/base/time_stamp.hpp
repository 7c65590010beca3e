// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

namespace bch::detail {

/// Reads the time-stamp counter of an x86 processor, which measurements of a few nanoseconds need. (Inlined for certain, so that instruction
/// sets share no function.)
[[gnu::always_inline]] inline std::uint64_t time_stamp() noexcept {
  return __builtin_ia32_rdtsc();
}

}  // namespace bch::detail
