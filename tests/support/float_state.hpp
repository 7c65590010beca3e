// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <vector>

#include "layout/base/floating_point_register.hpp"

namespace bch::test {

/// How a thread computes with floating point, as its processor's register says it.
struct FloatState {
  const char* name;
  unsigned bits;
};

inline unsigned float_state() {
  return detail::floating_point_register::read() & ~detail::floating_point_register::flags;
}
inline void set_float_state(unsigned bits) {
  detail::floating_point_register::write(bits);
}

inline std::vector<FloatState> odd_float_states() {
#if defined(__x86_64__)
  return {{"denormals are zero, both ways", 0x1f80 | 0x8040},
          {"down", 0x1f80 | 0x2000},
          {"up", 0x1f80 | 0x4000},
          {"towards zero", 0x1f80 | 0x6000},
          {"traps", 0x1f80 & ~0x680u}};
#elif defined(__aarch64__)  // traps are left out, because processors may do without
  return {{"denormals are zero", 1u << 24},
          {"one NaN", 1u << 25},
          {"up", 1u << 22},
          {"down", 2u << 22},
          {"towards zero", 3u << 22}};
#else
  return {{"down", FE_DOWNWARD}, {"up", FE_UPWARD}, {"towards zero", FE_TOWARDZERO}};
#endif
}

}  // namespace bch::test
