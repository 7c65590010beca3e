// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/runtime/floating_point_state.hpp"

#include <xmmintrin.h>

namespace bch::detail {
namespace {

constexpr unsigned standard = 0x1f80;  ///< of the register MXCSR: all traps masked
constexpr unsigned flags = 0x3f;       ///< say what has happened, and change nothing

bool is_standard(unsigned state) {
  return (state & ~flags) == standard;
}

}  // namespace

// The function is not inline, so that no computation moves out of the guarded part. Writing the register
// takes longer than reading it.
FloatingPointStateGuard::FloatingPointStateGuard() noexcept : before_(_mm_getcsr()) {
  if (!is_standard(before_)) _mm_setcsr(standard);
}

FloatingPointStateGuard::~FloatingPointStateGuard() {
  if (!is_standard(before_)) _mm_setcsr(before_);
}

}  // namespace bch::detail
