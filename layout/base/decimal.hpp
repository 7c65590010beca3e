// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <charconv>

namespace bch::detail {

/// Reads a double as std::from_chars() does, for standard libraries that have none of floating point; nan(...) ends behind nan.
std::from_chars_result decimal_from_chars(const char* begin, const char* end, double& value);

/// Reads a double, in any locale: "1.5", "-2e-3", infinities and NaN.
inline std::from_chars_result double_from_chars(const char* begin, const char* end, double& value) {
#ifdef __cpp_lib_to_chars
  return std::from_chars(begin, end, value);
#else  // as in Clang's libc++ before version 20
  return decimal_from_chars(begin, end, value);
#endif
}

}  // namespace bch::detail
