// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

namespace bch::detail {

/// Reads the time-stamp counter of an x86 processor, for measurements of a few nanoseconds. (Always inlined, so that
/// instruction sets share no function.)
[[gnu::always_inline]] inline std::uint64_t time_stamp() noexcept {
  return __builtin_ia32_rdtsc();
}

}  // namespace bch::detail
