// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <charconv>
#include <system_error>

namespace bch::detail {

/// Reads a double like std::from_chars(), for standard libraries without from_chars() for floating point. Reading of
/// nan(...) ends after nan. A number closer to 0 than any double, such as 1e-400, is read as 0 with its sign, without
/// an error.
std::from_chars_result decimal_from_chars(const char* begin, const char* end, double& value);

/// Reads a double, whatever the locale: "1.5", "-2e-3", infinities and NaN.
/// Errors:  result_out_of_range if the number is too large, such as 1e400; 1e-400 is read as 0.
inline std::from_chars_result double_from_chars(const char* begin, const char* end, double& value) {
#ifdef __cpp_lib_to_chars
  const std::from_chars_result read = std::from_chars(begin, end, value);
  if (read.ec != std::errc::result_out_of_range) return read;
#endif  // missing in Clang's libc++ before version 20
  return decimal_from_chars(begin, end, value);
}

}  // namespace bch::detail
