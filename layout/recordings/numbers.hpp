// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

#include "layout/base/decimal.hpp"

// Private to the readers of recordings: numbers of text files.

namespace bch::detail::trajectory {

/// Holds up to 15 digits, as a whole number, of which some follow a point.
struct PlainNumber {
  std::int64_t digits;
  std::size_t decimals;
  bool is_negative;
};

/// Reads a number as most files write them: digits, with a point between two of them, or without one.
inline std::optional<PlainNumber> plain_number_from(std::string_view text) {
  constexpr std::size_t longest = 15;
  PlainNumber number{0, 0, text.starts_with('-')};
  text.remove_prefix(number.is_negative ? 1 : 0);
  if (text.empty() || text.size() > longest || text.front() == '.' || text.back() == '.') return std::nullopt;
  bool behind_point = false;
  for (const char c : text) {
    if (c >= '0' && c <= '9')
      number.digits = 10 * number.digits + (c - '0'), number.decimals += behind_point;
    else if (c == '.' && !behind_point)
      behind_point = true;
    else
      return std::nullopt;
  }
  return number;
}

/// Reads a number that is all of a text, infinities and NaN included. The nearest double of a plain number is the quotient of
/// two whole numbers, both of which are doubles.
inline std::optional<double> number_from(std::string_view text) {
  constexpr double powers[] = {1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14};
  if (const auto plain = plain_number_from(text)) {
    const double number = static_cast<double>(plain->digits) / powers[plain->decimals];
    return plain->is_negative ? -number : number;
  }
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = double_from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || error == std::errc::invalid_argument) return std::nullopt;
  if (error != std::errc()) value = INFINITY;
  return value;
}

/// Returns a number that is whole, and not so large that its neighbours are not.
inline std::optional<std::int64_t> whole_number_from(double number) {
  constexpr double largest = 0x1p53;
  if (!(std::abs(number) <= largest) || std::trunc(number) != number) return std::nullopt;
  return static_cast<std::int64_t>(number);
}
inline std::optional<std::int64_t> whole_number_from(std::int64_t number) {
  return number;
}

/// Reads a whole number that is all of a text; "12.0" is one, too.
inline std::optional<std::int64_t> whole_number_from(std::string_view text) {
  if (const auto plain = plain_number_from(text); plain && plain->decimals == 0)
    return plain->is_negative ? -plain->digits : plain->digits;
  std::int64_t whole = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), whole);
  if (error == std::errc() && end == text.data() + text.size()) return whole;
  const std::optional<double> number = number_from(text);
  return number ? whole_number_from(*number) : std::nullopt;
}

}  // namespace bch::detail::trajectory
