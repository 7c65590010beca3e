// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/base/decimal.hpp"

#include <cmath>
#include <cstddef>
#include <locale>
#include <sstream>
#include <string>
#include <string_view>

namespace bch::detail {
namespace {

std::size_t digits_at(std::string_view text, std::size_t at) {
  const std::size_t end = text.find_first_not_of("0123456789", at);
  return (end == text.npos ? text.size() : end) - at;
}

/// Returns how long the number in digits is that the text begins with, or 0.
std::size_t decimal_size(std::string_view text) {
  std::size_t at = text.starts_with('-'), digits = digits_at(text, at);
  at += digits;
  if (text.substr(at).starts_with('.')) {
    const std::size_t more = digits_at(text, at + 1);
    digits += more, at += 1 + more;
  }
  if (digits == 0) return 0;
  const std::string_view rest = text.substr(at);
  if (!rest.starts_with('e') && !rest.starts_with('E')) return at;
  const std::size_t sign = rest.substr(1).starts_with('-') || rest.substr(1).starts_with('+');
  const std::size_t exponent = digits_at(rest, 1 + sign);
  return exponent == 0 ? at : at + 1 + sign + exponent;
}

/// Returns whether the text begins with a word, which is in lower case, in any case.
bool begins_with(std::string_view text, std::string_view word) {
  if (text.size() < word.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i)
    if ((text[i] | 0x20) != word[i]) return false;
  return true;
}

}  // namespace

std::from_chars_result decimal_from_chars(const char* begin, const char* end, double& value) {
  const std::string_view text(begin, static_cast<std::size_t>(end - begin));
  if (const std::size_t size = decimal_size(text); size != 0) {
    std::istringstream stream{std::string(text.substr(0, size))};
    stream.imbue(std::locale::classic());
    double read = 0;
    stream >> read;
    const bool is_tiny =
        std::abs(read) < 1;  // libc++ fails on numbers below the normal ones, too, and reads them
    if (stream.fail() && !is_tiny) return {begin + size, std::errc::result_out_of_range};
    value = read;
    return {begin + size, std::errc()};
  }
  const bool negative = text.starts_with('-');
  for (const std::string_view word : {"infinity", "inf", "nan"})
    if (begins_with(text.substr(negative), word)) {
      value = std::copysign(word[0] == 'n' ? std::nan("") : HUGE_VAL, negative ? -1.0 : 1.0);
      return {begin + negative + word.size(), std::errc()};
    }
  return {begin, std::errc::invalid_argument};
}

}  // namespace bch::detail
