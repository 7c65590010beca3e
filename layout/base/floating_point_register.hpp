// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

// This depends on the processor alone, also if BCH_SCALAR turns vectors off.
#if defined(__x86_64__)
#include <xmmintrin.h>
#elif !defined(__aarch64__)
#include <cfenv>
#endif

namespace bch::detail::floating_point_register {

#if defined(__x86_64__)
constexpr unsigned standard =
    0x1f80;                       ///< MXCSR: rounding to nearest, denormal numbers kept, all traps masked
constexpr unsigned flags = 0x3f;  ///< status bits, which change no result

inline unsigned read() noexcept {
  return _mm_getcsr();
}
inline void write(unsigned state) noexcept {
  _mm_setcsr(state);
}
#elif defined(__aarch64__)
constexpr unsigned standard = 0;  ///< FPCR: rounding to nearest, denormal numbers kept, no traps
constexpr unsigned flags = 0;     ///< status bits are in another register

inline unsigned read() noexcept {
  unsigned long bits;
  asm volatile("mrs %0, fpcr" : "=r"(bits));
  return static_cast<unsigned>(bits);
}
inline void write(unsigned state) noexcept {
  asm volatile("msr fpcr, %0" : : "r"(static_cast<unsigned long>(state)) : "memory");
}
#else
// On other processors, only the rounding mode of the standard library.
constexpr unsigned standard = FE_TONEAREST;
constexpr unsigned flags = 0;

inline unsigned read() noexcept {
  return static_cast<unsigned>(std::fegetround());
}
inline void write(unsigned state) noexcept {
  std::fesetround(static_cast<int>(state));
}
#endif

}  // namespace bch::detail::floating_point_register
