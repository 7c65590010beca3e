// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <vector>

#if defined(__x86_64__)
#include <xmmintrin.h>
#else
#include <cfenv>
#endif

namespace bch::test {

/// How a thread computes with floating point, as its processor's register says it.
struct FloatState {
  const char* name;
  unsigned bits;
};

#if defined(__x86_64__)
inline unsigned float_state() {
  constexpr unsigned flags = 0x3f;
  return _mm_getcsr() & ~flags;
}
inline void set_float_state(unsigned bits) {
  _mm_setcsr(bits);
}
/// Of MXCSR.
inline std::vector<FloatState> odd_float_states() {
  return {{"denormals are zero, both ways", 0x1f80 | 0x8040},
          {"down", 0x1f80 | 0x2000},
          {"up", 0x1f80 | 0x4000},
          {"towards zero", 0x1f80 | 0x6000},
          {"traps", 0x1f80 & ~0x680u}};
}
#elif defined(__aarch64__)
inline unsigned float_state() {
  unsigned long bits;
  asm volatile("mrs %0, fpcr" : "=r"(bits));
  return static_cast<unsigned>(bits);
}
inline void set_float_state(unsigned bits) {
  asm volatile("msr fpcr, %0" : : "r"(static_cast<unsigned long>(bits)) : "memory");
}
/// Of FPCR. Traps are left out, because processors may do without.
inline std::vector<FloatState> odd_float_states() {
  return {{"denormals are zero", 1u << 24},
          {"one NaN", 1u << 25},
          {"up", 1u << 22},
          {"down", 2u << 22},
          {"towards zero", 3u << 22}};
}
#else
inline unsigned float_state() {
  return static_cast<unsigned>(std::fegetround());
}
inline void set_float_state(unsigned bits) {
  std::fesetround(static_cast<int>(bits));
}
inline std::vector<FloatState> odd_float_states() {
  return {{"down", FE_DOWNWARD}, {"up", FE_UPWARD}, {"towards zero", FE_TOWARDZERO}};
}
#endif

}  // namespace bch::test
