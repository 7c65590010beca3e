// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <charconv>
#include <system_error>

namespace bch::detail {

/// Reads a double as std::from_chars() does, for standard libraries that have none of floating point; nan(...) ends behind nan. A number
/// closer to 0 than any double, such as 1e-400, is 0 with its sign, and no error.
std::from_chars_result decimal_from_chars(const char* begin, const char* end, double& value);

/// Reads a double, in any locale: "1.5", "-2e-3", infinities and NaN.
/// Errors:  result_out_of_range on numbers too large, such as 1e400; 1e-400 is 0.
inline std::from_chars_result double_from_chars(const char* begin, const char* end, double& value) {
#ifdef __cpp_lib_to_chars
  const std::from_chars_result read = std::from_chars(begin, end, value);
  if (read.ec != std::errc::result_out_of_range) return read;
#endif  // there is none in Clang's libc++ before version 20
  return decimal_from_chars(begin, end, value);
}

}  // namespace bch::detail
