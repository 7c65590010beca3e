// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/runtime/floating_point_state.hpp"

#if defined(__x86_64__)
#include <xmmintrin.h>
#elif !defined(__aarch64__)
#include <cfenv>
#endif

namespace bch::detail {
namespace {

#if defined(__x86_64__)
constexpr unsigned standard = 0x1f80;  ///< of the register MXCSR: all traps masked
constexpr unsigned flags = 0x3f;       ///< say what has happened, and change nothing

unsigned state() noexcept {
  return _mm_getcsr();
}
void set_state(unsigned state) noexcept {
  _mm_setcsr(state);
}
#elif defined(__aarch64__)
constexpr unsigned standard = 0;  ///< of the register FPCR: to nearest, denormal numbers kept, no traps
constexpr unsigned flags = 0;     ///< stand in another register

unsigned state() noexcept {
  unsigned long bits;
  asm volatile("mrs %0, fpcr" : "=r"(bits));
  return static_cast<unsigned>(bits);
}
void set_state(unsigned state) noexcept {
  asm volatile("msr fpcr, %0" : : "r"(static_cast<unsigned long>(state)) : "memory");
}
#else
// Of other processors the standard library's rounding mode.
constexpr unsigned standard = FE_TONEAREST;
constexpr unsigned flags = 0;

unsigned state() noexcept {
  return static_cast<unsigned>(std::fegetround());
}
void set_state(unsigned state) noexcept {
  std::fesetround(static_cast<int>(state));
}
#endif

bool is_standard(unsigned state) {
  return (state & ~flags) == standard;
}

}  // namespace

// The function is not inline, so that no computation moves out of the guarded part. Writing the register
// takes longer than reading it.
FloatingPointStateGuard::FloatingPointStateGuard() noexcept : before_(state()) {
  if (!is_standard(before_)) set_state(standard);
}

FloatingPointStateGuard::~FloatingPointStateGuard() {
  if (!is_standard(before_)) set_state(before_);
}

}  // namespace bch::detail
