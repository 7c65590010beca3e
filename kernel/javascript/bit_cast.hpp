// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <version>

// What emscripten's libc++ lacks of C++20. It is included before every source that is compiled for WebAssembly.
#if defined(__EMSCRIPTEN__) && !defined(__cpp_lib_bit_cast)
namespace std {
template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}
}  // namespace std
#endif
