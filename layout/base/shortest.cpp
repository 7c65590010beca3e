// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/base/shortest.hpp"

#include <charconv>
#include <cstdio>
#include <cstdlib>

namespace bch::detail {
namespace {

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 14000
/// Prints as std::to_chars() does, which this library lacks: with the fewest digits that name the value, in the shorter notation.
std::string digits_of(double value, bool is_float) {
  const auto printed = [&](const char* format, int precision) {
    char text[400];
    return std::string(text,
                       static_cast<std::size_t>(std::snprintf(text, sizeof text, format, precision, value)));
  };
  const auto names_value = [&](const std::string& text) {
    return is_float ? std::strtof(text.c_str(), nullptr) == static_cast<float>(value)
                    : std::strtod(text.c_str(), nullptr) == value;
  };
  int precision = 0;
  while (precision < 17 && !names_value(printed("%.*e", precision))) ++precision;
  const std::string scientific = printed("%.*e", precision);
  const std::size_t exponent = scientific.find('e');
  if (exponent == std::string::npos) return scientific;  // inf and nan
  const int digits = precision - std::atoi(scientific.c_str() + exponent + 1);
  const std::string fixed = printed("%.*f", digits > 0 ? digits : 0);
  return fixed.size() <= scientific.size() ? fixed : scientific;
}
std::string digits_of(double value) {
  return digits_of(value, false);
}
std::string digits_of(float value) {
  return digits_of(value, true);
}
#else
template <class Value>
std::string digits_of(Value value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}
#endif

}  // namespace

std::string shortest(double value) {
  return digits_of(value);
}

std::string shortest(float value) {
  return digits_of(value);
}

}  // namespace bch::detail
