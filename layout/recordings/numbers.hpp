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

/// Reads a number that is all of a text, infinities and NaN included.
inline std::optional<double> number_from(std::string_view text) {
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
  std::int64_t whole = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), whole);
  if (error == std::errc() && end == text.data() + text.size()) return whole;
  const std::optional<double> number = number_from(text);
  return number ? whole_number_from(*number) : std::nullopt;
}

}  // namespace bch::detail::trajectory
